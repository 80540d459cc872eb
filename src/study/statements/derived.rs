//! Numbers made of the series of a run.

use kynch_sim::scene::ObservableKind::Series;

use super::{Context, Reader, Written};
use crate::study::axes::is_name;
use crate::study::model::{Coordinate, Derivation, Derived, Reduction, Segment};
use crate::study::names::{is_measured_work, observables};
use crate::study::problem::Problems;
use crate::study::shape::Place;
use crate::study::spec::derived::{
    BreakpointSpec, CoordinateSpec, CrossingSpec, DerivedSpec, InterceptSpec, OverWindowSpec, PassesSpec,
    SignSpec, SlopeSpec, ValueAtSpec, WindowSpec,
};
use crate::study::units;
use crate::study::yaml::{Key, Node};

/// Segments that a series is parted into at most.
const MOST_SEGMENTS: u64 = 3;

/// Reads `derive`; entries at fault are reported and left out.
pub fn derived(root: &Node, context: &Context, problems: &mut Problems) -> Vec<Derived> {
    let entries = root.get("derive").map(Node::entries).unwrap_or_default();
    let schema = context.shapes.of("DerivedSpec");
    let mut list = Vec::new();
    for (name, node) in entries {
        let mut unsound = Problems::default();
        context.shapes.check(node, schema, &Place::root(), &mut unsound);
        let Some((kind, fields)) = node.entries().first().filter(|_| unsound.is_empty()) else {
            continue;
        };
        let Ok(spec) = serde_json::from_value::<DerivedSpec>(node.json()) else {
            continue;
        };
        let written = Written {
            kind,
            fields,
            path: format!("derive.{}.{}", name.name, kind.name),
        };
        let mut reader = Reader {
            written: &written,
            context,
            problems,
        };
        reader.name_of_derived(name);
        let (how, unit) = reader.derivation(spec);
        list.push(Derived {
            name: name.name.clone(),
            unit: unit.unwrap_or_else(|| "1".to_owned()),
            how,
        });
    }
    list
}

impl Reader<'_, '_> {
    fn name_of_derived(&mut self, name: &Key) {
        let mut observed = self.context.works.values().flat_map(observables);
        let taken = observed.any(|observable| observable.name == name.name);
        let (message, help) = if !is_name(&name.name) {
            (
                format!("`{}` is not a name", name.name),
                "use small letters, digits and _, beginning with a letter",
            )
        } else if taken || is_measured_work(&name.name) {
            (
                format!("a scene observes `{}` already", name.name),
                "choose another name",
            )
        } else {
            return;
        };
        let field = format!("derive.{}", name.name);
        self.problems.add(&name.span, &field, message, help);
    }

    /// How a number is made, and its unit where that is known.
    fn derivation(&mut self, spec: DerivedSpec) -> (Derivation, Option<String>) {
        match spec {
            DerivedSpec::Slope(SlopeSpec {
                of,
                over,
                window,
                segments,
                which,
                sign,
            }) => {
                let unit = self.unit_of_series("of", &of);
                let along = self.unit_along(over.as_deref());
                let unit = unit
                    .zip(along)
                    .and_then(|(unit, along)| units::per(&unit, &along));
                let line = self.segment(window, (segments.unwrap_or(1), 1), which, 0);
                let falling = sign == Some(SignSpec::Falling);
                let slope = Derivation::Slope {
                    of,
                    over,
                    line,
                    falling,
                };
                (slope, unit)
            }
            DerivedSpec::Intercept(InterceptSpec { of, over, window }) => {
                let unit = self.unit_of_series("of", &of);
                self.unit_along(over.as_deref());
                let line = self.segment(window, (1, 1), None, 0);
                (Derivation::Intercept { of, over, line }, unit)
            }
            DerivedSpec::Breakpoint(BreakpointSpec {
                of,
                window,
                segments,
                which,
            }) => {
                self.unit_of_series("of", &of);
                let line = self.segment(window, (segments, 2), which, 1);
                (Derivation::Breakpoint { of, line }, Some("s".to_owned()))
            }
            DerivedSpec::Crossing(spec) => self.crossing(spec),
            DerivedSpec::Value(ValueAtSpec { of, at }) => {
                let unit = self.unit_of_series("of", &of);
                (Derivation::Value { of, at: at.0 }, unit)
            }
            DerivedSpec::Mean(spec) => self.reduced(spec, Reduction::Mean),
            DerivedSpec::Smallest(spec) => self.reduced(spec, Reduction::Smallest),
            DerivedSpec::Largest(spec) => self.reduced(spec, Reduction::Largest),
            DerivedSpec::Passes(PassesSpec { of, share }) => {
                self.unit_of_series("of", &of);
                let (of, share) = (of, share.0);
                (Derivation::Passes { of, share }, Some("s".to_owned()))
            }
        }
    }

    fn reduced(&mut self, spec: OverWindowSpec, to: Reduction) -> (Derivation, Option<String>) {
        let unit = self.unit_of_series("of", &spec.of);
        let window = self.segment(spec.window, (1, 1), None, 0).window;
        let of = spec.of;
        (Derivation::Reduced { of, window, to }, unit)
    }

    /// Unit of the series in the place of time, or of time.
    fn unit_along(&mut self, over: Option<&str>) -> Option<String> {
        match over {
            Some(over) => self.unit_of_series("over", over),
            None => Some("s".to_owned()),
        }
    }

    fn crossing(&mut self, spec: CrossingSpec) -> (Derivation, Option<String>) {
        let (one, other) = (
            self.unit_of_series("of", &spec.of),
            self.unit_of_series("with", &spec.with),
        );
        if spec.of == spec.with {
            self.fault("with", "a series does not meet itself", "name another series");
        }
        if let (Some(one), Some(other)) = (&one, &other)
            && let Err((one, other)) = crate::study::comparable(one, other)
        {
            let message = format!("`{}` is {one}, `{}` is {other}", spec.of, spec.with);
            self.fault("with", message, "only series of one dimension meet");
        }
        let line = self.segment(spec.window, (spec.segments.unwrap_or(1), 1), spec.which, 0);
        let (take, unit) = match spec.take {
            Some(CoordinateSpec::Value) => (Coordinate::Value, one),
            Some(CoordinateSpec::Time) | None => (Coordinate::Time, Some("s".to_owned())),
        };
        let of = [spec.of, spec.with];
        (Derivation::Crossing { of, line, take }, unit)
    }

    /// Checks that a scene offers a series; gives its unit.
    fn unit_of_series(&mut self, field: &str, name: &str) -> Option<String> {
        self.observable(field, name, &[Series])
            .map(|dimension| dimension.unit())
    }

    /// A window and a segment of it; `least` segments are needed, the last `after` are not asked for.
    fn segment(
        &mut self,
        window: WindowSpec,
        (segments, least): (u64, u64),
        which: Option<u64>,
        after: u64,
    ) -> Segment {
        if let (Some(from), Some(to)) = (window.from, window.to)
            && from.0 >= to.0
        {
            let message = format!("the window ends at {} s, before it begins at {} s", to.0, from.0);
            self.fault("to", message, "let `to` be later than `from`");
        }
        if !(least..=MOST_SEGMENTS).contains(&segments) {
            let message =
                format!("`segments` is {segments}, it must lie between {least} and {MOST_SEGMENTS}");
            let help = "two part a fall from a plateau, three also a start from both";
            self.fault("segments", message, help);
        }
        let which = which.unwrap_or(1);
        let last = segments.saturating_sub(after).max(1);
        if !(1..=last).contains(&which) {
            let message = format!("`which` is {which}, it must lie between 1 and {last}");
            self.fault(
                "which",
                message,
                "segments count from 1, from the start of the window",
            );
        }
        Segment {
            window: [window.from.map(|time| time.0), window.to.map(|time| time.0)],
            segments: segments as usize,
            which: which as usize,
        }
    }
}
