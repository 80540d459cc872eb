//! Strokes, texts and the areas they take.

use super::theme::{self, Colour, Dash};

pub type Position = (i32, i32);

#[derive(Clone, Copy, Debug)]
pub struct Stroke {
    pub colour: Colour,
    pub width: u32,
    pub dash: Dash,
    pub opacity: f64,
}

impl Stroke {
    pub fn solid(colour: Colour, width: u32) -> Stroke {
        Stroke {
            colour,
            width,
            dash: theme::SOLID,
            opacity: 1.0,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// A rectangle: left, top, right, bottom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    pub left: i32,
    pub top: i32,
    pub right: i32,
    pub bottom: i32,
}

impl Area {
    pub fn around(centre: Position, half: i32) -> Area {
        Area {
            left: centre.0 - half,
            top: centre.1 - half,
            right: centre.0 + half,
            bottom: centre.1 + half,
        }
    }

    pub fn meets(&self, other: &Area) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    pub fn contains(&self, other: &Area) -> bool {
        self.left <= other.left
            && self.top <= other.top
            && self.right >= other.right
            && self.bottom >= other.bottom
    }
}

/// A piece of text; its position is the middle of its height.
#[derive(Clone, Debug)]
pub struct Text {
    pub words: String,
    pub at: Position,
    pub size: i32,
    pub anchor: Anchor,
    pub colour: Colour,
    /// Reads upwards.
    pub turned: bool,
}

impl Text {
    pub fn new(words: impl Into<String>, at: Position, size: i32, anchor: Anchor) -> Text {
        Text {
            words: words.into(),
            at,
            size,
            anchor,
            colour: theme::INK,
            turned: false,
        }
    }

    /// Estimated outline.
    pub fn area(&self) -> Area {
        let width = theme::text_width(&self.words, self.size);
        let before = match self.anchor {
            Anchor::Start => 0,
            Anchor::Middle => width / 2,
            Anchor::End => width,
        };
        let half = self.size * 6 / 10;
        let (x, y) = self.at;
        if self.turned {
            return Area {
                left: x - half,
                right: x + half,
                top: y - width + before,
                bottom: y + before,
            };
        }
        Area {
            left: x - before,
            right: x - before + width,
            top: y - half,
            bottom: y + half,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_text_stands_upright() {
        let mut text = Text::new("velocity (mm/s)", (500, 2000), theme::TEXT, Anchor::Middle);
        let lying = text.area();
        text.turned = true;
        let standing = text.area();
        assert_eq!(lying.right - lying.left, standing.bottom - standing.top);
        assert!(((standing.top + standing.bottom) / 2 - 2000).abs() <= 1);
    }
}
