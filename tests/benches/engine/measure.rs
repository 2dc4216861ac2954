//! Times on a machine that others use, too: contenders take turns, the median counts, least and most are shown.
//!
//! What runs on one core is measured by the time that its thread had on a core; what uses all cores or the disk, by the
//! clock on the wall.

use std::time::{Duration, Instant};

/// What a contender took for one of its units, round by round \[s\], smallest first.
#[derive(Clone)]
pub struct Times(Vec<f64>);

impl Times {
    /// From seconds in any order.
    pub fn new(mut seconds: Vec<f64>) -> Self {
        seconds.sort_by(f64::total_cmp);
        Self(seconds)
    }

    pub fn median_s(&self) -> f64 {
        self.0[self.0.len() / 2]
    }

    pub fn least_s(&self) -> f64 {
        self.0[0]
    }

    pub fn most_s(&self) -> f64 {
        self.0[self.0.len() - 1]
    }

    pub fn rounds(&self) -> usize {
        self.0.len()
    }

    /// The same times counted in other units.
    pub fn scaled(&self, factor: f64) -> Self {
        Self(self.0.iter().map(|seconds| seconds * factor).collect())
    }
}

/// Which seconds count.
#[derive(Clone, Copy)]
pub enum Clock {
    /// Those of the calling thread on a core (where the system tells them, else as on the wall).
    Core,
    /// Those on the wall.
    Wall,
}

impl Clock {
    /// Seconds that `work` takes.
    pub fn time(self, work: impl FnOnce()) -> f64 {
        match self {
            Self::Core => {
                let start = core_s();
                work();
                core_s() - start
            }
            Self::Wall => {
                let start = Instant::now();
                work();
                start.elapsed().as_secs_f64()
            }
        }
    }
}

/// Seconds that the calling thread has had on a core.
#[cfg(target_os = "linux")]
fn core_s() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// Seconds since the first call.
#[cfg(not(target_os = "linux"))]
fn core_s() -> f64 {
    static FIRST: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    FIRST.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// One contender: what it does in a round, and how many units that is.
pub type Contender<'a> = (usize, &'a mut dyn FnMut());

/// Rounds that are always made, and that suffice in any case.
const FEWEST: usize = 3;
const ENOUGH: usize = 25;
/// No more rounds are begun after this time.
const BUDGET: Duration = Duration::from_millis(1500);
/// A first round shorter than this is made for warming up only.
const SHORT: Duration = Duration::from_millis(400);

/// Lets contenders take turns; seconds per unit of each.
pub fn race<const N: usize>(clock: Clock, mut contenders: [Contender<'_>; N]) -> [Times; N] {
    let mut times: [Vec<f64>; N] = std::array::from_fn(|_| Vec::new());
    let begin = Instant::now();
    let mut round = |times: &mut [Vec<f64>; N]| {
        for ((count, work), times) in contenders.iter_mut().zip(times) {
            times.push(clock.time(work) / *count as f64);
        }
    };
    round(&mut times);
    if begin.elapsed() < SHORT {
        times.iter_mut().for_each(Vec::clear);
    }
    while times[0].len() < FEWEST || (begin.elapsed() < BUDGET && times[0].len() < ENOUGH) {
        round(&mut times);
    }
    times.map(Times::new)
}

/// Seconds on the wall of a single run of what takes too long to repeat.
pub fn once(work: impl FnOnce()) -> Times {
    Times::new(vec![Clock::Wall.time(work)])
}
