//! A law that is fitted over an axis.

use kynch_sim::scene::ObservableKind::{Profile, Scalar, Series};

use super::Reader;
use crate::study::model::{AxisValue, Band, FigureKind, FitTarget, FittedLaw, LawFit, Parameter};
use crate::study::spec::quantity::AnyQuantity;
use crate::study::spec::statement::{
    Caption, Common, FitSpec, FluxSpec, MapSpec, ParameterSpec, RichardsonZakiFigureSpec, RichardsonZakiSpec,
    ScaleSpec, ValueSpec,
};
use crate::study::units::Dimension;

/// Points that tell a law and how certain it is.
const LEAST_POINTS: usize = 3;

impl Reader<'_, '_> {
    pub(super) fn fit(&mut self, spec: &FitSpec) -> LawFit {
        let (law, unit) = self.richardson_zaki(&spec.richardson_zaki);
        let (parameter, unit) = match spec.parameter {
            Some(ParameterSpec::Velocity) => (Parameter::Velocity, unit),
            Some(ParameterSpec::Exponent) | None => (Parameter::Exponent, Some(Dimension::NONE)),
        };
        let target = match &spec.against {
            Some(against) => self.beside_reference(spec, against),
            None => FitTarget::Band(self.band_of_parameter(spec, parameter, unit)),
        };
        LawFit {
            law,
            parameter,
            target,
        }
    }

    pub(super) fn richardson_zaki(&mut self, spec: &RichardsonZakiSpec) -> (FittedLaw, Option<Dimension>) {
        let unit = self.observable("richardson_zaki.of", &spec.of, &[Scalar]);
        self.numeric_axis("richardson_zaki.over", &spec.over);
        self.porosities("richardson_zaki.over", &spec.over, LEAST_POINTS);
        (law(spec), unit)
    }

    /// A settling velocity with its fitted law.
    pub(super) fn settling(&mut self, spec: RichardsonZakiFigureSpec) -> (Caption, FigureKind) {
        self.observable("of", &spec.of, &[Scalar]);
        self.numeric_axis("over", &spec.over);
        self.porosities("over", &spec.over, LEAST_POINTS);
        if let Some(against) = &spec.against {
            self.reference(against, Some(&spec.of));
        }
        let law = law(&RichardsonZakiSpec {
            of: spec.of,
            over: spec.over,
            scale: spec.scale,
        });
        let kind = FigureKind::RichardsonZaki {
            law,
            against: spec.against,
            group: spec.caption.group.clone(),
        };
        (spec.caption, kind)
    }

    /// A flux curve with its chords.
    pub(super) fn flux(&mut self, spec: FluxSpec) -> (Caption, FigureKind) {
        self.observable("of", &spec.of, &[Scalar]);
        self.numeric_axis("over", &spec.over);
        self.porosities("over", &spec.over, 1);
        self.reference(&spec.against, Some(&spec.of));
        if let Some(deposit) = &spec.deposit {
            self.observable("deposit", deposit, &[Scalar]);
        }
        let kind = FigureKind::Flux {
            of: spec.of,
            over: spec.over,
            against: spec.against,
            deposit: spec.deposit,
            group: spec.caption.group.clone(),
        };
        (spec.caption, kind)
    }

    /// A picture of a profile with curves on top.
    pub(super) fn map(&mut self, spec: MapSpec) -> (Caption, FigureKind) {
        self.observable("of", &spec.of, &[Profile]);
        self.one_point();
        let curves = spec.curves.map(|curves| curves.0).unwrap_or_default();
        for curve in &curves {
            self.observable("curves", curve, &[Series]);
        }
        let against = spec.against.map(|against| against.0).unwrap_or_default();
        for name in &against {
            self.reference(name, curves.first());
        }
        if spec.caption.group.is_some() {
            let message = "`group` does not go with a picture of one point";
            self.fault("group", message, "leave it out");
        }
        let kind = FigureKind::Map {
            of: spec.of,
            curves,
            against,
        };
        (spec.caption, kind)
    }

    /// Checks that the values of an axis are porosities, and enough of them.
    fn porosities(&mut self, place: &str, over: &str, least: usize) {
        let Some(axis) = self.context.axes.iter().find(|axis| axis.axis.name == over) else {
            return;
        };
        let numbers = axis.axis.values.iter().filter_map(|value| match value {
            AxisValue::Number(number) => Some(*number),
            _ => None,
        });
        let numbers: Vec<f64> = numbers.collect();
        if let Some(number) = numbers.iter().find(|number| !(**number > 0.0 && **number <= 1.0)) {
            let message = format!("the axis `{over}` has the value {number}, which is no porosity");
            self.fault(place, message, "let `over` name the axis of the porosity");
        } else if (2..least).contains(&numbers.len()) {
            let message = format!(
                "the axis `{over}` has {} values, a fit needs three",
                numbers.len()
            );
            self.fault(place, message, "add porosities to the axis");
        }
    }

    fn beside_reference(&mut self, spec: &FitSpec, against: &str) -> FitTarget {
        self.reference(against, Some(&spec.richardson_zaki.of));
        let band = [
            ("is", spec.is.is_some()),
            ("within", spec.within.is_some()),
            ("above", spec.above.is_some()),
        ];
        for (name, _) in band.iter().filter(|(_, given)| *given) {
            let message = format!("`{name}` stands beside `against`");
            self.fault(
                name,
                message,
                "beside a reference the bound is `below`, a share of it",
            );
        }
        let below = match spec.below {
            None => {
                let help = "add `below: 1 %`, the bound on the relative difference";
                self.fault("against", "`against` needs `below`", help);
                0.0
            }
            Some(AnyQuantity { value, dimension }) => {
                if let Some(found) = dimension.filter(|found| *found != Dimension::NONE) {
                    let message = format!("`below` is {found}, beside `against` it is a pure number");
                    self.fault("below", message, "write a share such as `1 %`");
                }
                self.above_zero("below", value);
                value
            }
        };
        FitTarget::Reference {
            against: against.to_owned(),
            below,
        }
    }

    fn band_of_parameter(&mut self, spec: &FitSpec, parameter: Parameter, unit: Option<Dimension>) -> Band {
        let nothing =
            spec.is.is_none() && spec.above.is_none() && spec.below.is_none() && spec.within.is_none();
        if nothing {
            let help = "add `against` with `below`, or `is` with `within`, or `above`, or `below`";
            self.fault("richardson_zaki", "this expects nothing of the fit", help);
            return Band::default();
        }
        let called = match parameter {
            Parameter::Exponent => "exponent",
            Parameter::Velocity => "velocity",
        };
        let bounds = ValueSpec {
            of: called.to_owned(),
            is: spec.is,
            within: spec.within,
            above: spec.above,
            below: spec.below,
            common: Common::default(),
        };
        self.band(&bounds, unit)
    }
}

fn law(spec: &RichardsonZakiSpec) -> FittedLaw {
    FittedLaw {
        of: spec.of.clone(),
        over: spec.over.clone(),
        linear: spec.scale == Some(ScaleSpec::Linear),
    }
}
