//! Bounds and identifiers of a statement.

use super::Reader;
use crate::study::model::{Band, Limit};
use crate::study::spec::quantity::AnyQuantity;
use crate::study::spec::statement::{Common, LimitSpec, ValueSpec};
use crate::study::units::Dimension;
use kynch_sim::scene::ObservableKind::Scalar;

impl Reader<'_, '_> {
    /// Bounds of a `value` expectation in SI units.
    pub(super) fn band(&mut self, spec: &ValueSpec, unit: Option<Dimension>) -> Band {
        for (name, bound) in [("is", spec.is), ("above", spec.above), ("below", spec.below)] {
            let Some(found) = bound.and_then(|bound| bound.dimension) else {
                continue;
            };
            if let Some(unit) = unit.filter(|unit| *unit != found) {
                let message = format!("`{name}` is {found}, `{}` is {unit}", spec.of);
                self.fault(name, message, format!("write it in {}", unit.unit()));
            }
        }
        let bound = |quantity: Option<AnyQuantity>| quantity.map(|quantity| quantity.value);
        let band = Band {
            above: bound(spec.above),
            below: bound(spec.below),
        };
        match (spec.is, spec.within, band) {
            (
                Some(is),
                Some(within),
                Band {
                    above: None,
                    below: None,
                },
            ) => {
                self.above_zero("within", within.0);
                let half = is.value.abs() * within.0;
                Band {
                    above: Some(is.value - half),
                    below: Some(is.value + half),
                }
            }
            (
                None,
                None,
                Band {
                    above: Some(above),
                    below: Some(below),
                },
            ) if above >= below => {
                let message = format!("no value lies above {above} and below {below}");
                self.fault("above", message, "`above` is the lower bound");
                band
            }
            (
                None,
                None,
                Band {
                    above: None,
                    below: None,
                },
            ) => {
                self.fault(
                    "of",
                    "this expects no particular value",
                    "add `is` with `within`, or `above`, or `below`",
                );
                band
            }
            (None, None, band) => band,
            (Some(_), None, _) => {
                self.fault(
                    "is",
                    "`is` needs `within`",
                    "add `within: 1 %`, the relative half width of the band",
                );
                band
            }
            (None, Some(_), _) => {
                self.fault(
                    "within",
                    "`within` needs `is`",
                    "add `is:` with the value expected",
                );
                band
            }
            (Some(_), Some(_), _) => {
                self.fault(
                    "is",
                    "`is` stands beside `above` or `below`",
                    "keep one of the two forms",
                );
                band
            }
        }
    }

    /// A band that is left along an axis, with the reference for the place.
    pub(super) fn limit(&mut self, spec: &LimitSpec) -> Limit {
        let unit = self.observable("of", &spec.of, &[Scalar]);
        let bounds = ValueSpec {
            of: spec.of.clone(),
            is: None,
            within: None,
            above: spec.above,
            below: spec.below,
            common: Common::default(),
        };
        let band = self.band(&bounds, unit);
        self.numeric_axis("over", &spec.over);
        self.reference(&spec.against, None);
        Limit {
            of: spec.of.clone(),
            band,
            over: spec.over.clone(),
            against: spec.against.clone(),
            within: spec.within.0,
        }
    }

    pub(super) fn above_zero(&mut self, name: &str, value: f64) {
        if value <= 0.0 {
            self.fault(
                name,
                format!("`{name}` is {value}, it must be above 0"),
                "write a positive number",
            );
        }
    }

    pub(super) fn check_id(&mut self, id: &str, taken: bool) {
        let letters =
            |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || "-_.".contains(letter);
        if !id.starts_with(|first: char| first.is_ascii_alphanumeric())
            || !id.chars().all(letters)
            || id.len() > 80
        {
            let help = "use small letters, digits, -, _ and ., beginning with a letter or digit";
            self.fault("id", format!("`{id}` cannot be an identifier"), help);
        } else if taken {
            self.fault("id", format!("the identifier `{id}` is taken"), "choose another");
        }
    }
}
