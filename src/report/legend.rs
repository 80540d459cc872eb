//! The legend below the axes.

use super::canvas::{Anchor, Position, Stroke, Text};
use super::panel::Panel;
use super::theme::{self, Style};

/// A line of the legend.
#[derive(Clone, Debug)]
pub struct Entry {
    pub label: String,
    pub style: Style,
    pub markers: bool,
    pub line: bool,
    /// Markers are outlines.
    pub open: bool,
}

impl Panel {
    /// Entries row by row, in as many columns as fit. Gives back the lower edge.
    pub fn legend(&mut self, legend: &[Entry]) -> i32 {
        let mut lower = self.below;
        if legend.is_empty() {
            return lower;
        }
        if let Some(heading) = self.heading.take() {
            let at = (self.plot.left, lower + theme::GAP + theme::LEGEND_ROW / 2);
            self.canvas
                .text(Text::new(heading, at, theme::TEXT, Anchor::Start));
            lower += theme::LEGEND_ROW;
        }
        // What is no run stands in a row of its own, unless there is room for all in one.
        let room = theme::WIDTH - theme::BORDER - self.plot.left;
        let (runs, others): (Vec<&Entry>, Vec<&Entry>) = legend.iter().partition(|entry| entry.markers);
        let whole: Vec<&Entry> = legend.iter().collect();
        let blocks = if columns(&whole, room).len() == legend.len() {
            vec![whole]
        } else {
            vec![runs, others]
        };
        for block in blocks {
            lower = self.legend_block(&block, lower);
        }
        lower + theme::GAP
    }

    fn legend_block(&mut self, legend: &[&Entry], upper: i32) -> i32 {
        if legend.is_empty() {
            return upper;
        }
        let widths = columns(legend, theme::WIDTH - theme::BORDER - self.plot.left);
        let whole: i32 = widths.iter().sum();
        // One wide entry may need the space below the axis labels, too.
        let left = self
            .plot
            .left
            .min(theme::WIDTH - theme::BORDER - whole)
            .max(theme::BORDER);
        for (index, entry) in legend.iter().enumerate() {
            let (row, column) = (index / widths.len(), index % widths.len());
            let x = left + widths[..column].iter().sum::<i32>();
            let y = upper + theme::GAP + row as i32 * theme::LEGEND_ROW + theme::LEGEND_ROW / 2;
            self.legend_entry(entry, (x, y));
        }
        let rows = legend.len().div_ceil(widths.len()) as i32;
        upper + rows * theme::LEGEND_ROW
    }

    fn legend_entry(&mut self, entry: &Entry, (x, y): Position) {
        if entry.line {
            let stroke = Stroke {
                dash: entry.style.dash,
                ..Stroke::solid(entry.style.colour, theme::LINE_STROKE)
            };
            self.canvas.line((x, y), (x + theme::SAMPLE, y), stroke);
        }
        let sample = sample_width(entry);
        if entry.markers {
            let middle = (x + sample / 2, y);
            let Style { marker, colour, .. } = entry.style;
            match entry.open {
                true => self.canvas.open_marker(marker, middle, colour),
                false => self.canvas.marker(marker, middle, colour, 1.0),
            }
        }
        let at = (x + sample + theme::GAP, y);
        self.canvas
            .text(Text::new(&entry.label, at, theme::TEXT, Anchor::Start));
    }
}

/// A line needs more room than a marker alone.
fn sample_width(entry: &Entry) -> i32 {
    if entry.line {
        theme::SAMPLE
    } else {
        theme::MARKER * 3
    }
}

/// Widths of the most columns that fit into a legend.
fn columns(legend: &[&Entry], room: i32) -> Vec<i32> {
    let width = |entry: &&Entry| {
        sample_width(entry) + theme::GAP + theme::text_width(&entry.label, theme::TEXT) + 3 * theme::GAP
    };
    let widths = |columns: usize| -> Vec<i32> {
        let column = |column| {
            legend
                .iter()
                .skip(column)
                .step_by(columns)
                .map(width)
                .max()
                .unwrap_or(0)
        };
        (0..columns).map(column).collect()
    };
    let fitting = (1..=legend.len())
        .rev()
        .map(widths)
        .find(|widths| widths.iter().sum::<i32>() <= room);
    fitting.unwrap_or_else(|| widths(1))
}
