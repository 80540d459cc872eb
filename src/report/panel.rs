//! The frame of a figure: axes, ticks, grid, titles and the legend below.

use super::ReportError;
use super::axis::Scale;
use super::canvas::{Anchor, Area, Canvas, Position, Stroke, Text};
use super::legend::Entry;
use super::theme;

/// One axis with its title.
#[derive(Clone, Debug)]
pub struct Axis {
    pub title: String,
    pub scale: Scale,
}

/// A canvas with axes; figures draw on it in displayed units.
pub struct Panel {
    pub canvas: Canvas,
    pub x: Axis,
    pub y: Axis,
    /// The area between the axes.
    pub plot: Area,
    /// What the entries of the legend are values of: written above them.
    pub heading: Option<String>,
    /// Lower edge of the axis title: where the legend begins.
    pub below: i32,
}

impl Panel {
    /// Draws grid, axes, ticks and titles.
    pub fn new(x: Axis, y: Axis) -> Panel {
        Panel::beside(x, y, theme::RIGHT_MARGIN)
    }

    /// The same with more room to the right of the axes.
    pub fn beside(x: Axis, y: Axis, room: i32) -> Panel {
        let widest = y.scale.ticks().iter().filter_map(|tick| tick.label.as_deref());
        let widest = widest
            .map(|label| theme::text_width(label, theme::SMALL_TEXT))
            .max()
            .unwrap_or(0);
        let left = theme::BORDER + theme::TEXT * 12 / 10 + theme::GAP + widest + theme::GAP + theme::TICK;
        let top = theme::BORDER + theme::SMALL_TEXT / 2;
        let title = theme::text_width(&y.title, theme::TEXT) + theme::GAP;
        let plot = Area {
            left,
            top,
            right: theme::WIDTH - room,
            bottom: top + theme::PLOT_HEIGHT.max(title),
        };
        let mut panel = Panel {
            canvas: Canvas::default(),
            x,
            y,
            plot,
            heading: None,
            below: 0,
        };
        panel.horizontal_axis();
        panel.vertical_axis();
        panel
    }

    /// A smaller pair of axes on top of this one: what it covers is blank, titles are those around it.
    pub fn inset(&mut self, plot: Area, x: Scale, y: Scale, fill: impl FnOnce(&mut Panel)) {
        let untitled = |scale: Scale| Axis {
            title: String::new(),
            scale,
        };
        let widest = y.ticks().iter().filter_map(|tick| tick.label.as_deref());
        let widest = widest
            .map(|label| theme::text_width(label, theme::SMALL_TEXT))
            .max();
        let mut canvas = std::mem::take(&mut self.canvas);
        canvas.blank(Area {
            left: plot.left - theme::TICK - theme::GAP * 3 / 2 - widest.unwrap_or(0),
            top: plot.top - theme::SMALL_TEXT / 2 - theme::GAP,
            right: plot.right + theme::GAP * 2,
            bottom: plot.bottom + theme::TICK + theme::GAP + theme::SMALL_TEXT * 3 / 2,
        });
        let mut inner = Panel {
            canvas,
            x: untitled(x),
            y: untitled(y),
            plot,
            heading: None,
            below: 0,
        };
        inner.horizontal_axis();
        inner.vertical_axis();
        fill(&mut inner);
        self.canvas = inner.canvas;
    }

    /// Place of a pair of displayed numbers.
    pub fn at(&self, x: f64, y: f64) -> Position {
        (self.across(x), self.up(y))
    }

    pub fn across(&self, x: f64) -> i32 {
        let width = f64::from(self.plot.right - self.plot.left);
        self.plot.left + (self.x.scale.fraction(x) * width).round() as i32
    }

    pub fn up(&self, y: f64) -> i32 {
        let height = f64::from(self.plot.bottom - self.plot.top);
        self.plot.bottom - (self.y.scale.fraction(y) * height).round() as i32
    }

    fn horizontal_axis(&mut self) {
        let Area {
            left,
            top,
            right,
            bottom,
        } = self.plot;
        let label_height = bottom + theme::TICK + theme::GAP + theme::SMALL_TEXT / 2;
        let mut occupied = i32::MIN;
        for tick in self.x.scale.ticks().to_vec() {
            let x = self.across(tick.at);
            let length = if tick.label.is_some() {
                theme::TICK
            } else {
                theme::MINOR_TICK
            };
            if tick.label.is_some() {
                self.canvas.line(
                    (x, top),
                    (x, bottom),
                    Stroke::solid(theme::GRID, theme::GRID_STROKE),
                );
            }
            let stroke = Stroke::solid(theme::INK, theme::AXIS_STROKE);
            self.canvas.line((x, bottom), (x, bottom + length), stroke);
            let Some(label) = tick.label else { continue };
            let text = Text::new(label, (x, label_height), theme::SMALL_TEXT, Anchor::Middle);
            // A label that would touch its neighbour is left out; its tick stays.
            let area = text.area();
            if area.left > occupied && area.right < theme::WIDTH - theme::BORDER / 2 {
                occupied = area.right + theme::GAP;
                self.canvas.text(text);
            }
        }
        if self.x.title.is_empty() {
            return;
        }
        let middle = label_height + theme::SMALL_TEXT / 2 + theme::GAP + theme::TEXT / 2;
        let title = Text::new(
            &self.x.title,
            ((left + right) / 2, middle),
            theme::TEXT,
            Anchor::Middle,
        );
        self.canvas.text(title);
        self.below = middle + theme::TEXT / 2 + theme::GAP;
    }

    fn vertical_axis(&mut self) {
        let Area {
            left,
            top,
            right,
            bottom,
        } = self.plot;
        let mut occupied = i32::MAX;
        for tick in self.y.scale.ticks().to_vec() {
            let y = self.up(tick.at);
            let length = if tick.label.is_some() {
                theme::TICK
            } else {
                theme::MINOR_TICK
            };
            if tick.label.is_some() {
                self.canvas.line(
                    (left, y),
                    (right, y),
                    Stroke::solid(theme::GRID, theme::GRID_STROKE),
                );
            }
            self.canvas.line(
                (left, y),
                (left - length, y),
                Stroke::solid(theme::INK, theme::AXIS_STROKE),
            );
            let Some(label) = tick.label else { continue };
            let x = left - theme::TICK - theme::GAP;
            let text = Text::new(label, (x, y), theme::SMALL_TEXT, Anchor::End);
            let area = text.area();
            if area.bottom < occupied {
                occupied = area.top - theme::GAP / 4;
                self.canvas.text(text);
            }
        }
        // Axes lie above the grid.
        let stroke = Stroke::solid(theme::INK, theme::AXIS_STROKE);
        self.canvas
            .path(&[(left, top), (left, bottom), (right, bottom)], stroke);
        if self.y.title.is_empty() {
            return;
        }
        let at = (theme::BORDER + theme::TEXT * 6 / 10, (top + bottom) / 2);
        let mut title = Text::new(&self.y.title, at, theme::TEXT, Anchor::Middle);
        title.turned = true;
        self.canvas.text(title);
    }

    /// A horizontal line across the plot with its label; nothing when it lies outside.
    pub fn level(&mut self, y: f64, label: &str) {
        if !(0.0..=1.0).contains(&self.y.scale.fraction(y)) {
            return;
        }
        let height = self.up(y);
        let Area { left, right, top, .. } = self.plot;
        let stroke = Stroke {
            dash: theme::BOUND_DASH,
            ..Stroke::solid(theme::SOFT, theme::THIN_STROKE)
        };
        self.canvas.line((left, height), (right, height), stroke);
        self.canvas.take_path(&[(left, height), (right, height)]);
        let above = height - theme::SMALL_TEXT * 3 / 4;
        let below = height + theme::SMALL_TEXT * 3 / 4;
        let mut places = Vec::new();
        for y in [above, below] {
            places.push(((right - theme::GAP, y), Anchor::End));
            places.push(((left + theme::GAP, y), Anchor::Start));
            places.push((((left + right) / 2, y), Anchor::Middle));
        }
        let texts: Vec<Text> = places
            .into_iter()
            .map(|(at, anchor)| Text {
                colour: theme::SOFT,
                ..Text::new(label, at, theme::SMALL_TEXT, anchor)
            })
            .filter(|text| text.area().top >= top)
            .collect();
        let free = texts.iter().find(|text| self.canvas.is_free(&text.area()));
        if let Some(text) = free.or(texts.first()).cloned() {
            self.canvas.take(text.area());
            self.canvas.text(text);
        }
    }

    /// Puts a label beside a marker that reaches `half` around its place, where it covers nothing.
    pub fn label_beside(&mut self, at: Position, half: i32, label: &str, colour: theme::Colour) {
        let (near, far) = (half + 50, half + 170);
        let places = [
            ((near, -far / 2), Anchor::Start),
            ((-near, -far / 2), Anchor::End),
            ((0, -far - 40), Anchor::Middle),
            ((0, far + 40), Anchor::Middle),
            ((near, far / 2), Anchor::Start),
            ((-near, far / 2), Anchor::End),
            ((near, -far), Anchor::Start),
            ((-near, far), Anchor::End),
        ];
        let candidates: Vec<Text> = places
            .iter()
            .map(|((right, down), anchor)| Text {
                colour,
                ..Text::new(label, (at.0 + right, at.1 + down), theme::SMALL_TEXT, *anchor)
            })
            .filter(|text| self.plot.contains(&text.area()))
            .collect();
        let free = candidates.iter().find(|text| self.canvas.is_free(&text.area()));
        if let Some(text) = free.or(candidates.first()).cloned() {
            self.canvas.take(text.area());
            self.canvas.text(text);
        }
    }

    /// Writes the legend below the axes and gives back the SVG document with its height.
    pub fn finish(
        mut self,
        legend: &[Entry],
        id: &str,
        title: &str,
        description: &str,
    ) -> Result<Drawing, ReportError> {
        let height = self.legend(legend) + theme::BORDER;
        Drawing::of(&self.canvas, height, id, title, description)
    }
}

/// A finished figure.
#[derive(Clone, Debug)]
pub struct Drawing {
    pub svg: String,
    /// Estimated outlines of its texts, in hundredths of a millimetre.
    #[cfg(test)]
    pub texts: Vec<(String, Area)>,
    #[cfg(test)]
    pub height: i32,
}

impl Drawing {
    /// The SVG document of a canvas.
    pub fn of(
        canvas: &Canvas,
        height: i32,
        id: &str,
        title: &str,
        description: &str,
    ) -> Result<Drawing, ReportError> {
        Ok(Drawing {
            svg: canvas.svg(height, id, title, description)?,
            #[cfg(test)]
            texts: canvas.text_areas(),
            #[cfg(test)]
            height,
        })
    }
}
