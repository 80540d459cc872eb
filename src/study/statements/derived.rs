//! Numbers made of the series of a run.

use kynch_sim::scene::ObservableKind::Series;

use super::{Context, Reader, Written};
use crate::study::axes::is_name;
use crate::study::model::{Coordinate, Derivation, Derived, Segment};
use crate::study::names::{is_measured_work, observables};
use crate::study::problem::Problems;
use crate::study::shape::Place;
use crate::study::spec::derived::{
    BreakpointSpec, CoordinateSpec, CrossingSpec, DerivedSpec, SignSpec, SlopeSpec, WindowSpec,
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
                window,
                segments,
                which,
                sign,
            }) => {
                let unit = self
                    .unit_of_series("of", &of)
                    .and_then(|unit| units::per_time(&unit));
                let line = self.segment(window, (segments.unwrap_or(1), 1), which, 0);
                let falling = sign == Some(SignSpec::Falling);
                (Derivation::Slope { of, line, falling }, unit)
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
