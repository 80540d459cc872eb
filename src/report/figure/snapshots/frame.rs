//! Panels of equal scale side by side, with ticks in one unit, and the colour bar.

use super::super::super::axis::{Scale, Tick};
use super::super::super::canvas::{Anchor, Area, Canvas, Position, Stroke, Text};
use super::super::super::colour_map;
use super::super::super::theme;
use crate::report::format::{self, Unit};

/// What a panel shows [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub left: f64,
    pub right: f64,
    pub low: f64,
    pub high: f64,
}

impl Bounds {
    /// The same with some extent on both axes.
    pub fn sound(self) -> Bounds {
        let finite = [self.left, self.right, self.low, self.high]
            .iter()
            .all(|side| side.is_finite());
        match finite && self.right > self.left && self.high > self.low {
            true => self,
            false => Bounds {
                left: 0.0,
                right: 1e-3,
                low: 0.0,
                high: 1e-3,
            },
        }
    }

    fn width(&self) -> f64 {
        self.right - self.left
    }

    fn height(&self) -> f64 {
        self.high - self.low
    }
}

/// Room for all panels of one column.
const MOST_HEIGHT: i32 = 15_000;
const LEAST_PANEL: i32 = 400;
/// Colours of the bar.
const STEPS: i32 = 64;
const BAR_WIDTH: i32 = 320;

/// Where the panels stand.
#[derive(Clone, Debug)]
pub struct Layout {
    bounds: Bounds,
    unit: Unit,
    columns: usize,
    count: usize,
    /// Hundredths of a millimetre on paper per metre.
    scale: f64,
    left: i32,
    panel: (i32, i32),
}

/// One panel.
#[derive(Clone, Debug)]
pub struct Frame {
    area: Area,
    bounds: Bounds,
    unit: Unit,
    scale: f64,
    /// Whether it carries the numbers and the title of the vertical axis, and of the horizontal one.
    titles: (bool, bool),
}

impl Layout {
    /// As large as the page lets them be, in as many columns as that takes.
    pub fn of(bounds: &Bounds, count: usize) -> Layout {
        let unit = format::readable("m", bounds.width().max(bounds.height()) / 10.0);
        let ticks = ticks(bounds.low, bounds.high, &unit);
        let widest = ticks.iter().filter_map(|tick| tick.label.as_deref());
        let widest = widest
            .map(|label| theme::text_width(label, theme::SMALL_TEXT))
            .max();
        let left = theme::BORDER + theme::TEXT * 12 / 10 + 2 * theme::GAP + widest.unwrap_or(0) + theme::TICK;
        let room = theme::WIDTH - left - bar_room();
        let scale = |columns: usize| {
            let rows = count.div_ceil(columns) as i32;
            let gaps = between() * (columns as i32 - 1);
            let across = f64::from(room - gaps) / columns as f64 / bounds.width();
            let up = f64::from(MOST_HEIGHT / rows - overhead()) / bounds.height();
            across.min(up)
        };
        // Fewer columns only where that makes the panels larger.
        let best = (1..=count.max(1)).rev().fold((1, f64::MIN), |best, columns| {
            let scale = scale(columns);
            if scale > 1.05 * best.1 {
                (columns, scale)
            } else {
                best
            }
        });
        let size = |length: f64| ((length * best.1).round() as i32).max(LEAST_PANEL);
        let panel = (size(bounds.width()), size(bounds.height()));
        let taken = best.0 as i32 * (panel.0 + between()) - between();
        Layout {
            bounds: *bounds,
            unit,
            columns: best.0,
            count,
            scale: best.1,
            // Narrow panels stand in the middle of the page.
            left: left + (room - taken).max(0) / 2,
            panel,
        }
    }

    fn rows(&self) -> usize {
        self.count.div_ceil(self.columns)
    }

    pub fn height(&self) -> i32 {
        let rows = self.rows() as i32;
        theme::BORDER * 2 + rows * (self.panel.1 + overhead())
    }

    pub fn frame(&self, index: usize) -> Frame {
        let (row, column) = (index / self.columns, index % self.columns);
        let left = self.left + column as i32 * (self.panel.0 + between());
        let top = theme::BORDER + heading() + row as i32 * (self.panel.1 + overhead());
        let below_is_none = index + self.columns >= self.count;
        Frame {
            area: Area {
                left,
                top,
                right: left + self.panel.0,
                bottom: top + self.panel.1,
            },
            bounds: self.bounds,
            unit: self.unit.clone(),
            scale: self.scale,
            titles: (column == 0, below_is_none),
        }
    }

    /// The colours of speeds from zero to the largest.
    pub fn colour_bar(&self, canvas: &mut Canvas, fastest: f64) {
        let first = self.frame(0).area;
        let last = self.frame(self.columns.min(self.count) - 1).area;
        let left = last.right + theme::GAP * 3;
        let area = Area {
            left,
            right: left + BAR_WIDTH,
            ..first
        };
        let height = |share: f64| area.bottom - (share * f64::from(area.bottom - area.top)).round() as i32;
        for step in 0..STEPS {
            // Each reaches up behind those above it, so that no seam shows.
            let (low, high) = (height(f64::from(step) / f64::from(STEPS)), area.top);
            let share = f64::from(step) / f64::from(STEPS - 1);
            let corners = vec![
                (area.left, low),
                (area.right, low),
                (area.right, high),
                (area.left, high),
            ];
            canvas.area(corners, colour_map::colour(share), 1.0);
        }
        rectangle(canvas, &area);
        let unit = format::readable("m/s", fastest);
        let most = if fastest > 0.0 { fastest * unit.factor } else { 1.0 };
        let scale = Scale::tight([0.0, most]).with_at_most(5);
        let mut widest = 0;
        // Where everything rests there is one speed to tell.
        for tick in scale
            .ticks()
            .iter()
            .filter(|tick| fastest > 0.0 || tick.at == 0.0)
        {
            let y = height(scale.fraction(tick.at));
            let stroke = Stroke::solid(theme::INK, theme::AXIS_STROKE);
            canvas.line((area.right, y), (area.right + theme::TICK, y), stroke);
            let label = tick
                .label
                .as_deref()
                .map(|label| if fastest > 0.0 { label } else { "0" });
            let Some(label) = label else { continue };
            let at = (area.right + theme::TICK + theme::GAP, y);
            widest = widest.max(theme::text_width(label, theme::SMALL_TEXT));
            canvas.text(Text::new(label, at, theme::SMALL_TEXT, Anchor::Start));
        }
        let x = area.right + theme::TICK + theme::GAP * 2 + widest + theme::TEXT * 6 / 10;
        let label = format!("speed{}", unit.in_brackets());
        let mut title = Text::new(
            label,
            (x, (area.top + area.bottom) / 2),
            theme::TEXT,
            Anchor::Middle,
        );
        title.turned = true;
        canvas.text(title);
    }
}

impl Frame {
    pub fn at(&self, x: f64, z: f64) -> Position {
        (
            self.area.left + self.length(x - self.bounds.left),
            self.area.bottom - self.length(z - self.bounds.low),
        )
    }

    pub fn length(&self, length: f64) -> i32 {
        (length * self.scale).round() as i32
    }

    /// Time above, ticks with their numbers where the panel is at the edge.
    pub fn draw(&self, canvas: &mut Canvas, time: &str) {
        let Area { left, top, right, .. } = self.area;
        let above = (left, top - theme::GAP - theme::SMALL_TEXT / 2);
        let words = [format!("t = {time}"), time.to_owned()];
        let fitting = words
            .iter()
            .find(|words| theme::text_width(words, theme::SMALL_TEXT) <= right - left + between());
        let words = fitting.unwrap_or(&words[1]);
        canvas.text(Text::new(words, above, theme::SMALL_TEXT, Anchor::Start));
        self.horizontal(canvas);
        self.vertical(canvas);
    }

    fn horizontal(&self, canvas: &mut Canvas) {
        let Area {
            left, right, bottom, ..
        } = self.area;
        let stroke = Stroke::solid(theme::INK, theme::AXIS_STROKE);
        let height = bottom + theme::TICK + theme::GAP + theme::SMALL_TEXT / 2;
        let mut occupied = i32::MIN;
        for tick in ticks(self.bounds.left, self.bounds.right, &self.unit) {
            let x = self.at(tick.at / self.unit.factor, 0.0).0;
            canvas.line((x, bottom), (x, bottom + theme::TICK), stroke);
            let Some(label) = tick.label.as_deref() else {
                continue;
            };
            let text = Text::new(label, (x, height), theme::SMALL_TEXT, Anchor::Middle);
            if text.area().left > occupied {
                occupied = text.area().right + theme::GAP;
                canvas.text(text);
            }
        }
        if self.titles.1 {
            let below = height + theme::SMALL_TEXT / 2 + theme::GAP + theme::TEXT / 2;
            let title = format!("x{}", self.unit.in_brackets());
            canvas.text(Text::new(
                title,
                ((left + right) / 2, below),
                theme::TEXT,
                Anchor::Middle,
            ));
        }
    }

    fn vertical(&self, canvas: &mut Canvas) {
        let Area {
            left, top, bottom, ..
        } = self.area;
        let stroke = Stroke::solid(theme::INK, theme::AXIS_STROKE);
        let mut occupied = i32::MAX;
        let mut occupied_from = left - theme::TICK;
        for tick in ticks(self.bounds.low, self.bounds.high, &self.unit) {
            let y = self.at(0.0, tick.at / self.unit.factor).1;
            canvas.line((left - theme::TICK, y), (left, y), stroke);
            let label = tick.label.as_deref().filter(|_| self.titles.0);
            let Some(label) = label else { continue };
            let at = (left - theme::TICK - theme::GAP, y);
            let text = Text::new(label, at, theme::SMALL_TEXT, Anchor::End);
            if text.area().bottom < occupied {
                occupied = text.area().top;
                occupied_from = occupied_from.min(text.area().left);
                canvas.text(text);
            }
        }
        if self.titles.0 {
            let at = (
                occupied_from - theme::GAP - theme::TEXT * 6 / 10,
                (top + bottom) / 2,
            );
            let title = format!("z{}", self.unit.in_brackets());
            let mut title = Text::new(title, at, theme::TEXT, Anchor::Middle);
            title.turned = true;
            canvas.text(title);
        }
    }

    /// The walls, above the grains.
    pub fn outline(&self, canvas: &mut Canvas) {
        rectangle(canvas, &self.area);
    }
}

fn rectangle(canvas: &mut Canvas, area: &Area) {
    let Area {
        left,
        top,
        right,
        bottom,
    } = *area;
    let stroke = Stroke::solid(theme::INK, theme::AXIS_STROKE);
    canvas.path(
        &[
            (left, top),
            (right, top),
            (right, bottom),
            (left, bottom),
            (left, top),
        ],
        stroke,
    );
}

/// Ticks of one axis in displayed units.
fn ticks(low: f64, high: f64, unit: &Unit) -> Vec<Tick> {
    let (low, high) = (low * unit.factor, high * unit.factor);
    let scale = Scale::tight([low, high]).with_at_most(4);
    let slack = 1e-9 * (high - low);
    let ticks = scale.ticks().iter().cloned();
    ticks.filter(|tick| tick.at >= low - slack).collect()
}

/// Between two panels.
fn between() -> i32 {
    4 * theme::GAP
}

/// Above a panel: the time.
fn heading() -> i32 {
    theme::SMALL_TEXT + 2 * theme::GAP
}

/// What a panel needs above and below.
fn overhead() -> i32 {
    heading() + theme::TICK + theme::SMALL_TEXT + theme::TEXT + 4 * theme::GAP
}

/// The colour bar with its numbers and title.
fn bar_room() -> i32 {
    let numbers = theme::text_width("0.000", theme::SMALL_TEXT);
    theme::GAP * 6 + BAR_WIDTH + theme::TICK + numbers + theme::TEXT * 12 / 10 + theme::RIGHT_MARGIN / 2
}
