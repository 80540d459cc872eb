//! Marks on paper: collected in hundredths of a millimetre, written as SVG by plotters.
//!
//! plotters draws on whole pixels only; at a hundred pixels per millimetre the rounding is far below
//! what a printer resolves. Dashes are drawn as geometry, because the SVG backend has none.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::ReportError;
pub use super::mark::{Anchor, Area, Position, Stroke, Text};
use super::theme::{self, Colour, Dash, Marker};

#[derive(Clone, Debug)]
enum Mark {
    Path(Vec<Position>, Stroke),
    Polygon(Vec<Position>, Colour, f64),
    Circle(Position, i32, Colour, f64),
    Text(Text),
    /// Many discs with one thin outline, the first at the back.
    Discs(Vec<Disc>),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    pub at: Position,
    pub radius: i32,
    pub colour: Colour,
}

#[derive(Clone, Debug, Default)]
pub struct Canvas {
    marks: Vec<Mark>,
    /// What labels must not cover.
    taken: Vec<Area>,
}

impl Canvas {
    pub fn path(&mut self, points: &[Position], stroke: Stroke) {
        let points = thinned(points);
        if points.len() < 2 {
            return;
        }
        if stroke.dash.is_empty() {
            self.marks.push(Mark::Path(points, stroke));
            return;
        }
        for piece in dashed(&points, stroke.dash) {
            self.marks.push(Mark::Path(piece, stroke));
        }
    }

    pub fn line(&mut self, from: Position, to: Position, stroke: Stroke) {
        self.path(&[from, to], stroke);
    }

    /// Thousands of discs: written as short as SVG allows.
    pub fn discs(&mut self, discs: Vec<Disc>) {
        self.marks.push(Mark::Discs(discs));
    }

    pub fn text(&mut self, text: Text) {
        self.marks.push(Mark::Text(text));
    }

    pub fn marker(&mut self, marker: Marker, at: Position, colour: Colour, opacity: f64) {
        self.marker_of(marker, at, theme::MARKER, colour, opacity);
    }

    /// The outline of a marker.
    pub fn open_marker(&mut self, marker: Marker, at: Position, colour: Colour) {
        self.marker_of(marker, at, theme::MARKER * 11 / 10, colour, 1.0);
        self.marker_of(marker, at, theme::MARKER * 6 / 10, theme::PAPER, 1.0);
    }

    /// A filled outline without a border.
    pub fn area(&mut self, corners: Vec<Position>, colour: Colour, opacity: f64) {
        let corners = thinned(&corners);
        if corners.len() > 2 {
            self.marks.push(Mark::Polygon(corners, colour, opacity));
        }
    }

    /// Hides what lies below an area.
    pub fn blank(&mut self, area: Area) {
        let corners = vec![
            (area.left, area.top),
            (area.right, area.top),
            (area.right, area.bottom),
            (area.left, area.bottom),
        ];
        self.marks.push(Mark::Polygon(corners, theme::PAPER, 1.0));
    }

    fn marker_of(&mut self, marker: Marker, at: Position, half: i32, colour: Colour, opacity: f64) {
        let (x, y) = at;
        let polygon = |corners: &[(i32, i32)]| {
            let corners = corners
                .iter()
                .map(|(right, down)| (x + right, y + down))
                .collect();
            Mark::Polygon(corners, colour, opacity)
        };
        let tall = half * 6 / 5;
        self.marks.push(match marker {
            Marker::Circle => Mark::Circle(at, half, colour, opacity),
            Marker::Square => {
                let side = half * 9 / 10;
                polygon(&[(-side, -side), (side, -side), (side, side), (-side, side)])
            }
            Marker::Triangle => polygon(&[(0, -tall), (tall, half), (-tall, half)]),
            Marker::Nabla => polygon(&[(0, tall), (tall, -half), (-tall, -half)]),
            Marker::Diamond => polygon(&[(0, -tall), (tall, 0), (0, tall), (-tall, 0)]),
            Marker::Cross => {
                let arm = half / 3;
                polygon(&[
                    (-arm, -half),
                    (arm, -half),
                    (arm, -arm),
                    (half, -arm),
                    (half, arm),
                    (arm, arm),
                    (arm, half),
                    (-arm, half),
                    (-arm, arm),
                    (-half, arm),
                    (-half, -arm),
                    (-arm, -arm),
                ])
            }
        });
    }

    /// Keeps labels placed later away from here.
    pub fn take(&mut self, area: Area) {
        self.taken.push(area);
    }

    /// Keeps labels away from a line.
    pub fn take_path(&mut self, points: &[Position]) {
        let step = theme::MARKER;
        for pair in points.windows(2) {
            let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
            let count = (dx.abs().max(dy.abs()) / step).max(1);
            for index in 0..=count {
                let at = (pair[0].0 + dx * index / count, pair[0].1 + dy * index / count);
                self.taken.push(Area::around(at, step / 2));
            }
        }
    }

    pub fn is_free(&self, area: &Area) -> bool {
        !self.taken.iter().any(|taken| taken.meets(area))
    }

    /// Estimated outlines of all texts.
    #[cfg(test)]
    pub fn text_areas(&self) -> Vec<(String, Area)> {
        let texts = self.marks.iter().filter_map(|mark| match mark {
            Mark::Text(text) => Some((text.words.clone(), text.area())),
            _ => None,
        });
        texts.collect()
    }

    /// The SVG document. `id` is unique in a page; `title` and `description` are read aloud.
    pub fn svg(&self, height: i32, id: &str, title: &str, description: &str) -> Result<String, ReportError> {
        let mut body = String::new();
        let is_discs = |mark: &Mark| matches!(mark, Mark::Discs(_));
        for marks in self.marks.chunk_by(|one, next| !is_discs(one) && !is_discs(next)) {
            body += &match marks {
                [Mark::Discs(discs)] => written(discs),
                marks => drawn(marks, height)
                    .map_err(|error| ReportError(format!("figure `{id}` cannot be drawn: {error}")))?,
            };
        }
        let (width_mm, height_mm) = (f64::from(theme::WIDTH) / 100.0, f64::from(height) / 100.0);
        let (title, description) = (escaped(title), escaped(description));
        Ok(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"kynch-figure\" width=\"{width_mm}mm\" \
             height=\"{height_mm}mm\" viewBox=\"0 0 {} {height}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-description\" stroke-linejoin=\"round\">\n\
             <title id=\"{id}-title\">{title}</title>\n<desc id=\"{id}-description\">{description}</desc>\n\
             <style>{}</style>\n{body}</svg>\n",
            theme::WIDTH,
            theme::style_sheet(),
        ))
    }
}

type Paper<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Marks as SVG elements, by plotters.
fn drawn(marks: &[Mark], height: i32) -> Result<String, Box<dyn std::error::Error>> {
    let mut document = String::new();
    {
        let size = (theme::WIDTH as u32, height as u32);
        let area = SVGBackend::with_string(&mut document, size).into_drawing_area();
        for mark in marks {
            draw(&area, mark)?;
        }
        area.present()?;
    }
    // The document around them is written once for all.
    let body = document.split_once('\n').map_or("", |(_, body)| body);
    let body = body.trim_end().trim_end_matches("</svg>");
    Ok(body.replace("\n</text>", "</text>").replace(" \"/>", "\"/>"))
}

fn written(discs: &[Disc]) -> String {
    let mut body = format!(
        "<g stroke=\"{}\" stroke-width=\"{}\">\n",
        theme::hex(theme::SOFT),
        theme::OUTLINE_STROKE
    );
    for Disc { at, radius, colour } in discs {
        let fill = theme::hex(*colour);
        let (x, y) = at;
        body.push_str(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{fill}\"/>\n"
        ));
    }
    body.push_str("</g>\n");
    body
}

fn draw(area: &Paper, mark: &Mark) -> Drawn {
    let paint = |colour: Colour, opacity: f64| RGBColor(colour.0, colour.1, colour.2).mix(opacity);
    let fill = |colour, opacity| ShapeStyle {
        color: paint(colour, opacity),
        filled: true,
        stroke_width: 0,
    };
    let done = match mark {
        Mark::Path(points, stroke) => {
            let style = ShapeStyle {
                color: paint(stroke.colour, stroke.opacity),
                filled: false,
                stroke_width: stroke.width,
            };
            area.draw(&PathElement::new(points.clone(), style))
        }
        Mark::Polygon(points, colour, opacity) => {
            area.draw(&Polygon::new(points.clone(), fill(*colour, *opacity)))
        }
        Mark::Circle(at, radius, colour, opacity) => {
            area.draw(&Circle::new(*at, *radius, fill(*colour, *opacity)))
        }
        // Written without plotters.
        Mark::Discs(_) => Ok(()),
        Mark::Text(text) => area.draw(&plotters::element::Text::new(
            text.words.clone(),
            text.at,
            text_style(text),
        )),
    };
    done.map_err(|error| error.to_string().into())
}

fn text_style(text: &Text) -> TextStyle<'static> {
    let horizontal = match text.anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    // The SVG backend divides sizes by 1.24.
    let font = (theme::FONT, f64::from(text.size) * 1.24).into_font();
    let turn = if text.turned {
        FontTransform::Rotate270
    } else {
        FontTransform::None
    };
    let (red, green, blue) = text.colour;
    let mut style = TextStyle::from(font.transform(turn)).pos(Pos::new(horizontal, VPos::Center));
    style.color = RGBColor(red, green, blue).to_backend_color();
    style
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// Without points that fall on their predecessor.
fn thinned(points: &[Position]) -> Vec<Position> {
    let mut kept = points.to_vec();
    kept.dedup();
    kept
}

/// Cuts a line into the drawn pieces of a dash pattern.
fn dashed(points: &[Position], dash: Dash) -> Vec<Vec<Position>> {
    let mut pieces = Vec::new();
    let mut piece = vec![points[0]];
    let (mut index, mut left) = (0, f64::from(dash[0]));
    for pair in points.windows(2) {
        let from = (f64::from(pair[0].0), f64::from(pair[0].1));
        let step = (f64::from(pair[1].0) - from.0, f64::from(pair[1].1) - from.1);
        let length = step.0.hypot(step.1);
        let mut walked = 0.0;
        while length - walked > left {
            walked += left;
            let share = walked / length;
            let here = (
                (from.0 + step.0 * share).round() as i32,
                (from.1 + step.1 * share).round() as i32,
            );
            if index % 2 == 0 {
                piece.push(here);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![here];
            }
            index = (index + 1) % dash.len();
            left = f64::from(dash[index]);
        }
        left -= length - walked;
        if index % 2 == 0 {
            piece.push(pair[1]);
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_keep_their_lengths_round_a_corner() {
        let pieces = dashed(&[(0, 0), (150, 0), (150, 150)], &[100, 50]);
        let length = |piece: &Vec<Position>| -> i32 {
            piece
                .windows(2)
                .map(|pair| (pair[1].0 - pair[0].0).abs() + (pair[1].1 - pair[0].1).abs())
                .sum()
        };
        assert_eq!(pieces.iter().map(length).collect::<Vec<_>>(), [100, 100]);
        assert_eq!(pieces[1].first(), Some(&(150, 0)));
    }
}
