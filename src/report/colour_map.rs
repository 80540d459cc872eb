//! Colours for a quantity: even steps look even, also without colour vision and without colour.
//!
//! Source: viridis, Smith & van der Walt (2015), every 17th of its 256 entries; linear in between.

use super::theme::Colour;

const VIRIDIS: [Colour; 16] = [
    (0x44, 0x01, 0x54),
    (0x48, 0x1A, 0x6C),
    (0x47, 0x2F, 0x7D),
    (0x41, 0x44, 0x87),
    (0x39, 0x56, 0x8C),
    (0x31, 0x68, 0x8E),
    (0x2A, 0x78, 0x8E),
    (0x23, 0x88, 0x8E),
    (0x1F, 0x98, 0x8B),
    (0x22, 0xA8, 0x84),
    (0x35, 0xB7, 0x79),
    (0x54, 0xC5, 0x68),
    (0x7A, 0xD1, 0x51),
    (0xA5, 0xDB, 0x36),
    (0xD2, 0xE2, 0x1B),
    (0xFD, 0xE7, 0x25),
];

/// The colour of a share of the largest value, from 0 (dark) to 1 (bright); what lies outside is cut.
pub fn colour(share: f64) -> Colour {
    let share = if share.is_finite() {
        share.clamp(0.0, 1.0)
    } else {
        0.0
    };
    let place = share * (VIRIDIS.len() - 1) as f64;
    let below = (place.floor() as usize).min(VIRIDIS.len() - 2);
    let (low, high) = (VIRIDIS[below], VIRIDIS[below + 1]);
    let mix = |low: u8, high: u8| {
        let value = f64::from(low) + (place - below as f64) * (f64::from(high) - f64::from(low));
        value.round() as u8
    };
    (mix(low.0, high.0), mix(low.1, high.1), mix(low.2, high.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE 1976 lightness of an sRGB colour.
    fn lightness((red, green, blue): Colour) -> f64 {
        let linear = |part: u8| {
            let part = f64::from(part) / 255.0;
            if part <= 0.04045 {
                part / 12.92
            } else {
                ((part + 0.055) / 1.055).powf(2.4)
            }
        };
        let luminance = 0.2126 * linear(red) + 0.7152 * linear(green) + 0.0722 * linear(blue);
        116.0 * luminance.cbrt() - 16.0
    }

    #[test]
    fn even_steps_are_even_steps_of_lightness() {
        let lights: Vec<f64> = (0..=60)
            .map(|step| lightness(colour(f64::from(step) / 60.0)))
            .collect();
        let whole = (lights[60] - lights[0]) / 60.0;
        assert!(whole > 1.0);
        for pair in lights.windows(2) {
            let step = pair[1] - pair[0];
            assert!(step > 0.4 * whole && step < 1.6 * whole, "{step} of {whole}");
        }
    }

    #[test]
    fn what_lies_outside_is_cut() {
        assert_eq!(colour(-1.0), colour(0.0));
        assert_eq!(colour(f64::NAN), colour(0.0));
        assert_eq!(colour(7.0), colour(1.0));
    }
}
