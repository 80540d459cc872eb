//! Batch settling as a wave of concentration (Kynch 1952), by the flux curve of a drag law.
//!
//! ```text
//! f(φ) = φ w(φ)          flux of solids, w the settling velocity of an even suspension
//! [f]/[φ]                speed at which a jump of concentration rises (negative: falls)
//! −f′(φ)                 speed at which a given concentration rises
//! ```
//!
//! Above is clear fluid, f(0) = 0; below a deposit of fraction φ_m that does not move, f(φ_m) = 0. From φ_0 to
//! φ_m the concentration follows the lower convex hull of f: jumps where the hull leaves the curve, a fan
//! of concentrations where it runs along it. That is the tangent construction:
//!
//! * type 1: the chord from (φ_0, f) to (φ_m, 0) lies below the curve: one jump, the bed's front.
//! * type 2: the curve is convex at φ_0 and the chord cuts it: a fan from φ_0 to φ*, then the jump.
//! * type 3: the curve is concave at φ_0 and the chord cuts it: a jump, a fan, and the jump to φ_m.
//!
//! φ*: where the tangent from (φ_m, 0) touches. For f = v φ (1 − φ)^n types 2 and 3 need φ_m > 4n/(n+1)².
//! Source: Kynch (1952), Trans. Faraday Soc. 48, 166–176.

/// Fractions at which the hull is sought before it is refined.
const POINTS: usize = 400;
/// Share of the way from φ_0 to φ_m below which a fan or a jump is none.
const LEAST: f64 = 1e-5;

/// A flux curve from a start to a deposit.
pub struct FluxCurve<F> {
    velocity: F,
    /// φ_0 [-]
    pub start: f64,
    /// φ_m [-]
    pub deposit: f64,
    /// The tangent construction.
    pub waves: Waves,
}

/// How a suspension of constant concentration settles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// The deposit's front is the only wave.
    One,
    /// A fan of concentrations rises before the deposit.
    Two,
    /// A jump, a fan and the deposit's front.
    Three,
}

/// What rises from the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waves {
    pub kind: Kind,
    /// The fraction at the fan's upper end; φ_m without a fan.
    pub first: f64,
    /// φ*, the fraction next to the deposit; φ_0 without a fan.
    pub last: f64,
}

impl<F: Fn(f64) -> f64> FluxCurve<F> {
    /// By the settling velocity w(φ) [m/s], which falls with φ; φ_0 and φ_m [-] with φ_0 < φ_m.
    pub fn new(velocity: F, start: f64, deposit: f64) -> Self {
        let mut curve = FluxCurve {
            velocity,
            start,
            deposit,
            waves: Waves {
                kind: Kind::One,
                first: deposit,
                last: start,
            },
        };
        curve.waves = curve.construct();
        curve
    }

    /// f [m/s]; zero in the deposit.
    pub fn flux(&self, fraction: f64) -> f64 {
        match fraction < self.deposit {
            true => fraction * (self.velocity)(fraction),
            false => 0.0,
        }
    }

    /// Speed at which a jump between two fractions rises [m/s].
    pub fn jump(&self, above: f64, below: f64) -> f64 {
        -(self.flux(below) - self.flux(above)) / (below - above)
    }

    /// Speed at which a fraction rises [m/s], −f′.
    pub fn characteristic(&self, fraction: f64) -> f64 {
        let step = 1e-5 * fraction.min(1.0 - fraction);
        let curve = |fraction: f64| fraction * (self.velocity)(fraction);
        -(curve(fraction + step) - curve(fraction - step)) / (2.0 * step)
    }

    fn construct(&self) -> Waves {
        let (start, deposit) = (self.start, self.deposit);
        let span = deposit - start;
        // The hull's side at φ_m begins where the jump to φ_m rises most slowly, its side at φ_0 ends where that
        // from φ_0 rises fastest.
        let last = highest(
            |fraction| -self.jump(fraction, deposit),
            start,
            deposit - LEAST * span,
        );
        if last < start + LEAST * span {
            return self.waves;
        }
        let first = highest(|fraction| self.jump(start, fraction), start + LEAST * span, last);
        let fan = first < start + 2.0 * LEAST * span;
        Waves {
            kind: if fan { Kind::Two } else { Kind::Three },
            first: if fan { start } else { first },
            last,
        }
    }

    /// Speed of the first wave from the floor that meets the falling interface [m/s].
    pub fn first_wave(&self) -> f64 {
        match self.waves.kind {
            Kind::One => self.jump(self.start, self.deposit),
            Kind::Two => self.characteristic(self.start),
            Kind::Three => self.jump(self.start, self.waves.first),
        }
    }

    /// Speed at which the deposit grows [m/s].
    pub fn bed_front(&self) -> f64 {
        self.jump(self.waves.last, self.deposit)
    }

    /// Time [s] and height [m] at which the interface of a column of `height` [m] meets the first wave.
    pub fn meeting(&self, height: f64) -> (f64, f64) {
        let wave = self.first_wave();
        let time = height / ((self.velocity)(self.start) + wave);
        (time, wave * time)
    }

    /// Height [m] of the interface of a column of `height` [m] at a time [s].
    pub fn interface(&self, height: f64, time: f64) -> f64 {
        let waves = self.waves;
        let (meeting, _) = self.meeting(height);
        let final_height = height * self.start / self.deposit;
        if time <= meeting {
            return height - time * (self.velocity)(self.start);
        }
        // In the fan the interface holds the fraction whose wave it meets: all solids passed that wave.
        let met_at = |fraction: f64| {
            let rise = self.characteristic(fraction);
            height * self.start / (self.flux(fraction) + fraction * rise)
        };
        if waves.kind == Kind::One || time >= met_at(waves.last) {
            return final_height;
        }
        let (mut low, mut high) = (waves.first, waves.last);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            match met_at(middle) < time {
                true => low = middle,
                false => high = middle,
            }
        }
        self.characteristic(low) * time
    }
}

/// Where a function is highest between two places: by points first, then by the golden section.
fn highest(function: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let step = (high - low) / POINTS as f64;
    let place = |index: usize| low + index as f64 * step;
    let values: Vec<f64> = (0..=POINTS).map(|index| function(place(index))).collect();
    let best = (0..=POINTS).fold(
        0,
        |best, index| if values[index] > values[best] { index } else { best },
    );
    let (mut low, mut high) = (place(best.saturating_sub(1)), place((best + 1).min(POINTS)));
    let section = 0.5 * (5f64.sqrt() - 1.0);
    while high - low > 1e-8 * high {
        let (left, right) = (high - section * (high - low), low + section * (high - low));
        match function(left) < function(right) {
            true => low = left,
            false => high = right,
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::library::tests::dataset;

    /// Richardson and Zaki with a terminal velocity of 1 m/s.
    fn curve(exponent: f64, start: f64, deposit: f64) -> FluxCurve<impl Fn(f64) -> f64> {
        FluxCurve::new(
            move |fraction: f64| (1.0 - fraction).powf(exponent),
            start,
            deposit,
        )
    }

    #[test]
    fn waves_stand_at_the_greatest_flux_and_are_fastest_where_the_curve_turns() {
        let table = dataset("richardson_zaki_analytic.csv");
        for row in 0..table.rows() {
            let exponent = table.number("n_rowe", row);
            let top = 1.0 - table.number("eps_max_flux_rowe", row);
            let turn = 1.0 - table.number("eps_inflection_rowe", row);
            let curve = curve(exponent, 0.01, 0.9);
            assert!(curve.characteristic(top).abs() < 1e-5);
            let fastest = curve.characteristic(turn);
            for other in [turn - 0.02, turn + 0.02] {
                assert!(curve.characteristic(other) < fastest);
            }
        }
    }

    #[test]
    fn beds_looser_than_the_tabulated_limit_settle_as_type_1_at_every_start() {
        let table = dataset("richardson_zaki_analytic.csv");
        for row in (0..table.rows()).step_by(4) {
            let exponent = table.number("n_rowe", row);
            let limit = table.number("phi_bed_type1_only_below_rowe", row);
            let kinds = |deposit: f64| -> Vec<Kind> {
                (1..20)
                    .map(|step| {
                        curve(exponent, deposit * f64::from(step) / 20.0, deposit)
                            .waves
                            .kind
                    })
                    .collect()
            };
            assert!(kinds(limit - 0.002).iter().all(|kind| *kind == Kind::One));
            assert!(kinds(limit + 0.02).iter().any(|kind| *kind != Kind::One));
        }
    }

    #[test]
    fn the_reference_suspension_meets_its_bed_after_0_977_seconds_at_1_2_millimetres() {
        let constant = FluxCurve::new(|_| 4.91237e-3, 0.1, 0.5);
        let (time, height) = constant.meeting(6e-3);
        assert!((time - 0.977126).abs() < 1e-6 && (height - 1.2e-3).abs() < 1e-12);
        assert!((constant.bed_front() - 1.22809e-3).abs() < 1e-8);
        assert!((constant.interface(6e-3, 2.0) - 1.2e-3).abs() < 1e-15);
    }

    #[test]
    fn types_follow_each_other_as_the_start_gets_denser() {
        let of = |start| curve(4.65, start, 0.7).waves;
        let kinds = [0.05, 0.25, 0.36, 0.65].map(|start| of(start).kind);
        assert_eq!(kinds, [Kind::One, Kind::Three, Kind::Two, Kind::One]);
        // φ* is where the tangent from the deposit touches, whatever the start.
        let curve = curve(4.65, 0.36, 0.7);
        let touching = curve.waves.last;
        let tangent = curve.characteristic(touching) / curve.jump(touching, 0.7);
        assert!((tangent - 1.0).abs() < 1e-3, "{tangent}");
        assert!((of(0.25).last - touching).abs() < 1e-4);
    }

    #[test]
    fn the_interface_never_jumps_and_ends_at_the_height_of_the_bed() {
        for start in [0.05, 0.25, 0.36] {
            let curve = curve(4.65, start, 0.7);
            let height = |time: f64| curve.interface(1.0, time);
            let end = start / 0.7;
            let mut last = 1.0;
            for step in 1..400 {
                let now = height(f64::from(step) * 0.05);
                assert!(
                    now <= last + 1e-12 && last - now < 0.05,
                    "{start}: {last} to {now}"
                );
                last = now;
            }
            assert!((last - end).abs() < 1e-12);
        }
    }
}
