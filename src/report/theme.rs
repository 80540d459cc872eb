//! Every size, colour, font and stroke of a figure. Lengths are in hundredths of a millimetre.
//!
//! Colours: Okabe & Ito (2008), "Color Universal Design", in an order that keeps neighbours apart;
//! their yellow is left out, because it cannot be read on white. A group differs from its neighbour
//! in colour, marker and dash, so that a figure survives a black-and-white printer.

/// Figure width.
pub const WIDTH: i32 = 12_000;
/// Height of the area between the axes.
pub const PLOT_HEIGHT: i32 = 6_400;
/// Empty border around everything.
pub const BORDER: i32 = 150;
/// Free space above the topmost and right of the rightmost tick.
pub const RIGHT_MARGIN: i32 = 350;
/// Gap between neighbours: tick and label, label and axis title.
pub const GAP: i32 = 120;

/// Axis titles and legend.
pub const TEXT: i32 = 340;
/// Tick labels and labels inside the plot.
pub const SMALL_TEXT: i32 = 300;
/// First the faces that journals ask for, then what is found on every system.
pub const FONT: &str = "Helvetica Neue, Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif";

pub const AXIS_STROKE: u32 = 18;
pub const GRID_STROKE: u32 = 10;
pub const LINE_STROKE: u32 = 36;
pub const THIN_STROKE: u32 = 22;
/// Around grains, in the colour of soft lines: it parts dark discs and bright ones alike.
pub const OUTLINE_STROKE: u32 = 8;
pub const TICK: i32 = 90;
pub const MINOR_TICK: i32 = 50;
/// Bands of scatter: two that cross stay visible.
pub const BAND_OPACITY: f64 = 0.2;
/// Half the extent of a marker.
pub const MARKER: i32 = 95;
/// Least radius of a grain in a picture.
pub const GRAIN_RADIUS: i32 = 4;
/// Half the width of the cap of an uncertainty bar.
pub const CAP: i32 = 70;
/// Length of the line sample in a legend.
pub const SAMPLE: i32 = 920;
pub const LEGEND_ROW: i32 = 480;

/// Red, green, blue.
pub type Colour = (u8, u8, u8);

/// What lies below: fills open markers and the ground of an inset.
pub const PAPER: Colour = (0xFF, 0xFF, 0xFF);
/// Axes, text, reference curves.
pub const INK: Colour = (0x1A, 0x1A, 0x1A);
/// Bounds, fronts, slope triangles.
pub const SOFT: Colour = (0x5F, 0x5F, 0x5F);
pub const GRID: Colour = (0xE2, 0xE2, 0xE2);

/// Colours beside their counterpart on a dark page.
const DARK: [(Colour, &str); 10] = [
    (PAPER, "#161616"),
    (INK, "#EDEDED"),
    (SOFT, "#A8A8A8"),
    (GRID, "#3A3A3A"),
    (BLUE, "#56A8E0"),
    (VERMILLION, "#F08040"),
    (GREEN, "#2CC79B"),
    (PURPLE, "#DB9ABF"),
    (ORANGE, "#F0B53A"),
    (SKY, "#84CBF2"),
];

const BLUE: Colour = (0x00, 0x72, 0xB2);
const VERMILLION: Colour = (0xD5, 0x5E, 0x00);
const GREEN: Colour = (0x00, 0x9E, 0x73);
const PURPLE: Colour = (0xCC, 0x79, 0xA7);
const ORANGE: Colour = (0xE6, 0x9F, 0x00);
const SKY: Colour = (0x56, 0xB4, 0xE9);

const COLOURS: [Colour; 6] = [BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
    Nabla,
}

const MARKERS: [Marker; 6] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Nabla,
    Marker::Cross,
];

/// Lengths drawn and left out, in turn; empty for a solid line.
pub type Dash = &'static [i32];

pub const SOLID: Dash = &[];
/// Reference curves.
pub const REFERENCE_DASH: Dash = &[220, 130];
/// Bounds.
pub const BOUND_DASH: Dash = &[60, 90];

const DASHES: [Dash; 6] = [
    SOLID,
    &[420, 140],
    &[60, 110],
    &[420, 110, 60, 110],
    &[700, 140],
    &[420, 110, 60, 110, 60, 110],
];

/// How one group is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    pub colour: Colour,
    pub marker: Marker,
    pub dash: Dash,
}

/// The style of the `index`-th group. After six groups colours come again with other dashes.
pub fn style(index: usize) -> Style {
    let round = index / COLOURS.len();
    Style {
        colour: COLOURS[index % COLOURS.len()],
        marker: MARKERS[(index + round) % MARKERS.len()],
        dash: DASHES[(index + round) % DASHES.len()],
    }
}

/// Opacity of the `index`-th of `count` lines that share a style: the first is the strongest.
pub fn fade(index: usize, count: usize) -> f64 {
    if count < 2 {
        return 1.0;
    }
    let step = index as f64 / (count - 1) as f64;
    ((1.0 - 0.6 * step) * 100.0).round() / 100.0
}

pub fn hex(colour: Colour) -> String {
    format!("#{:02X}{:02X}{:02X}", colour.0, colour.1, colour.2)
}

/// Style sheet inside each figure: other inks on a dark page, whether the figure stands alone or in
/// a page. Programs that know no media queries draw the light form.
pub fn style_sheet() -> String {
    let rules: String = DARK
        .iter()
        .map(|(light, dark)| {
            let light = hex(*light);
            format!(".kynch-figure [stroke=\"{light}\"]{{stroke:{dark}}}.kynch-figure [fill=\"{light}\"]{{fill:{dark}}}")
        })
        .collect();
    format!(":root{{color-scheme:light dark}}@media (prefers-color-scheme:dark){{{rules}}}")
}

/// A figure as a dark page shows it, for programs that know no media queries.
#[cfg(test)]
pub fn dark(svg: &str) -> String {
    DARK.iter().fold(svg.to_owned(), |svg, (light, dark)| {
        let light = hex(*light);
        let svg = svg.replace(&format!("stroke=\"{light}\""), &format!("stroke=\"{dark}\""));
        svg.replace(&format!("fill=\"{light}\""), &format!("fill=\"{dark}\""))
    })
}

/// Estimated width of a text, a little more than the widest of the usual sans-serif faces needs.
pub fn text_width(text: &str, size: i32) -> i32 {
    let ems: f64 = text.chars().map(advance).sum();
    (ems * f64::from(size)).ceil() as i32
}

/// Advance of a character over the type size.
fn advance(character: char) -> f64 {
    match character {
        'i' | 'j' | 'l' | '\'' | '|' => 0.29,
        ' ' | '.' | ',' | ':' | ';' | '!' => 0.33,
        'f' | 't' | 'r' | '(' | ')' | '-' | '/' | 'I' => 0.41,
        '⁰'..='⁹' | '²' | '³' | '¹' | '⁻' => 0.42,
        'm' | 'w' | 'M' | 'W' | '%' | '@' => 0.97,
        'A'..='Z' | '<' | '>' | '=' | '+' | '≤' | '≥' | '×' | '−' | '–' => 0.78,
        _ => 0.63,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_groups_differ_in_colour_marker_and_dash() {
        for index in 0..12 {
            let (here, next) = (style(index), style(index + 1));
            assert_ne!(here.colour, next.colour);
            assert_ne!(here.marker, next.marker);
            assert_ne!(here.dash, next.dash);
        }
    }

    #[test]
    fn eighteen_groups_have_eighteen_styles() {
        for first in 0..18 {
            for second in 0..first {
                assert_ne!(style(first), style(second), "{first} and {second}");
            }
        }
    }

    #[test]
    fn every_colour_has_a_form_for_dark_pages() {
        let sheet = style_sheet();
        for colour in COLOURS.iter().chain([&PAPER, &INK, &SOFT, &GRID]) {
            assert!(sheet.contains(&hex(*colour)));
        }
    }
}
