//! The slope triangle: the observed order beside a line, where nothing else is drawn.

use super::super::axis::Scale;
use super::super::canvas::{Anchor, Area, Position, Stroke, Text};
use super::super::panel::Panel;
use super::super::theme::{self, Style};

/// A right triangle with the slope of the observed order, beside a segment where nothing else is.
pub fn triangle(panel: &mut Panel, places: &[Position], order: f64, style: Style) {
    let label = format!("{order:.1}").replace('-', "−");
    if label == "0.0" || label == "−0.0" {
        return;
    }
    let width = (panel.plot.right - panel.plot.left) / 9;
    let decades = |scale: &Scale| (scale.high / scale.low).log10();
    let across = f64::from(width) / f64::from(panel.plot.right - panel.plot.left) * decades(&panel.x.scale);
    let tall = f64::from(panel.plot.bottom - panel.plot.top);
    let rise = (order * across / decades(&panel.y.scale) * tall).round() as i32;
    for (start, below) in candidates(places) {
        let far = theme::MARKER * 2;
        let (x, y) = if below {
            (start.0, start.1 + far)
        } else {
            (start.0, start.1 - far)
        };
        // Below the line the right angle lies right and low, above it left and high.
        let corners = if below {
            [(x, y), (x + width, y), (x + width, y - rise)]
        } else {
            [(x, y), (x, y - rise), (x + width, y - rise)]
        };
        let text = if below {
            Text::new(
                &label,
                (x + width + theme::GAP / 2, y - rise / 2),
                theme::SMALL_TEXT,
                Anchor::Start,
            )
        } else {
            Text::new(
                &label,
                (x - theme::GAP / 2, y - rise / 2),
                theme::SMALL_TEXT,
                Anchor::End,
            )
        };
        let free = panel.plot.contains(&text.area())
            && panel.canvas.is_free(&text.area())
            && outline_is_free(panel, &corners);
        if free {
            let closed = [corners[0], corners[1], corners[2], corners[0]];
            panel
                .canvas
                .path(&closed, Stroke::solid(style.colour, theme::THIN_STROKE));
            panel.canvas.take_path(&closed);
            panel.canvas.take(text.area());
            panel.canvas.text(Text {
                colour: style.colour,
                ..text
            });
            return;
        }
    }
}

/// Places to try, from the middle of the line outwards, nearer ones first.
fn candidates(places: &[Position]) -> Vec<(Position, bool)> {
    let middles = middles(places);
    let mut candidates = Vec::new();
    for away in [1, 2, 4, 6] {
        for pair in middles.windows(2) {
            let (one, other) = (pair[0], pair[1]);
            for quarter in [1, 2, 0, 3] {
                let at = |share: i32| one.0 + (other.0 - one.0) * share / 4;
                let up = |share: i32| one.1 + (other.1 - one.1) * share / 4;
                let shift = (away - 1) * theme::MARKER;
                candidates.push(((at(quarter), up(quarter) + shift), true));
                candidates.push(((at(quarter), up(quarter) - shift), false));
            }
        }
    }
    candidates
}

fn outline_is_free(panel: &Panel, corners: &[Position; 3]) -> bool {
    let closed = [corners[0], corners[1], corners[2], corners[0]];
    closed.windows(2).all(|pair| {
        (0..=12).all(|index| {
            let at = (
                pair[0].0 + (pair[1].0 - pair[0].0) * index / 12,
                pair[0].1 + (pair[1].1 - pair[0].1) * index / 12,
            );
            let area = Area::around(at, theme::MARKER / 2);
            panel.plot.contains(&area) && panel.canvas.is_free(&area)
        })
    })
}

/// One place per resolution: replicates share theirs.
pub fn middles(places: &[Position]) -> Vec<Position> {
    let mut middles: Vec<(i32, Vec<i32>)> = Vec::new();
    for (x, y) in places {
        match middles.last_mut() {
            Some((last, heights)) if last == x => heights.push(*y),
            _ => middles.push((*x, vec![*y])),
        }
    }
    middles
        .into_iter()
        .map(|(x, heights)| (x, heights.iter().sum::<i32>() / heights.len() as i32))
        .collect()
}
