//! How long points will take: from what earlier points took, or else from a stated rate.

use std::time::Duration;

use crate::store::Store;
use crate::store::model::{Run, Status};
use crate::study::model::{Point, Work};

/// Particle-steps per second and core taken where nothing has been measured yet.
pub const DEFAULT_RATE: f64 = 2e6;

/// Speed of this machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Particle-steps per second and core.
    pub speed: f64,
    /// Runs it was measured on; none for the default.
    pub measured_on: usize,
}

impl Rate {
    pub const DEFAULT: Rate = Rate {
        speed: DEFAULT_RATE,
        measured_on: 0,
    };

    /// From pairs of work [particle-steps] and time on one core [s]; pairs without either are left out.
    pub fn measured(pairs: impl Iterator<Item = (f64, f64)>) -> Rate {
        let pairs = pairs.filter(|(work, wall)| *work > 0.0 && *wall > 0.0);
        let (work, wall, runs) = pairs.fold((0.0, 0.0, 0), |(work, wall, runs), pair| {
            (work + pair.0, wall + pair.1, runs + 1)
        });
        if runs == 0 {
            Rate::DEFAULT
        } else {
            Rate {
                speed: work / wall,
                measured_on: runs,
            }
        }
    }

    /// From the completed runs in the store that have the settings of some point, of whatever
    /// version of the simulator.
    pub fn of_machine(points: &[&Point], store: &Store) -> Rate {
        let mut runs = store.summaries();
        runs.retain(|run| run.status == Status::Completed);
        Rate::measured(runs.iter().filter_map(|run| pair(points, run)))
    }

    /// Time of one point on the cores it takes.
    pub fn time(&self, work: &Work) -> Duration {
        match work {
            Work::Simulation(scene) => {
                let speed = self.speed * work.threads() as f64;
                seconds(kynch_sim::scene::describe(scene).work / speed)
            }
            Work::Rehearsal(rehearsal) => seconds(rehearsal.delay),
        }
    }
}

/// Work and time on one core of a run that has the settings of some point.
fn pair(points: &[&Point], run: &Run) -> Option<(f64, f64)> {
    let point = points.iter().find(|point| point.settings == run.settings)?;
    match &point.work {
        Work::Simulation(scene) => {
            let core_time = run.timing.wall * point.work.threads() as f64;
            Some((kynch_sim::scene::describe(scene).work, core_time))
        }
        Work::Rehearsal(_) => None,
    }
}

/// Time of several points, each with its threads, on some workers: no less than the longest one takes.
pub fn together(times: &[(Duration, usize)], workers: usize) -> Duration {
    let workers = workers.max(1);
    let busy = |(time, threads): &(Duration, usize)| *time * (*threads).min(workers) as u32;
    let shared: Duration = times.iter().map(busy).sum::<Duration>() / workers as u32;
    let longest = times.iter().map(|(time, _)| *time).max();
    longest.unwrap_or_default().max(shared)
}

fn seconds(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX / 1_000_000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speed_is_all_work_over_all_time() {
        let rate = Rate::measured([(1e6, 1.0), (5e6, 1.0), (0.0, 9.0), (1e6, 0.0)].into_iter());
        assert_eq!(
            rate,
            Rate {
                speed: 3e6,
                measured_on: 2
            }
        );
        assert_eq!(Rate::measured(std::iter::empty()), Rate::DEFAULT);
    }

    #[test]
    fn workers_share_but_the_longest_point_stays_whole() {
        let times = [4, 1, 1].map(|time| (Duration::from_secs(time), 1));
        assert_eq!(together(&times, 1).as_secs(), 6);
        assert_eq!(together(&times, 2).as_secs(), 4);
        let wide = [(Duration::from_secs(4), 2), (Duration::from_secs(2), 1)];
        assert_eq!(together(&wide, 2).as_secs(), 5);
        assert_eq!(together(&[], 2).as_secs(), 0);
    }
}
