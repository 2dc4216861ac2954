//! The noise in base-model fits, asked about for as many tightenings side by side as vector registers hold.

use crate::noise::integrated::{IntegratedNoise, drift, to_source};
use crate::noise::score_covariance::{OwnedNoise, ScoreCovariance, ScoreSums, Source};
use crate::noise::thresholds::STRETCHES;
use crate::residual::tightening::TighteningResidual;
use crate::task::FitTask;
use snug_campaign::Quantity;
use snug_least_squares::matrix::{entries_at, submatrix_at};
use snug_least_squares::{Fit, Residual};
use snug_model::{LaneTask, NormalEquations, Real, ScoredRecord, Sweep, Task, in_lanes};

/// A base-model fit whose noise is asked about.
pub(crate) struct FittedInSweeps<'r, 'a> {
    pub residual: &'r mut TighteningResidual<'a>,
    pub task: &'a FitTask<'a>,
    pub fit: &'r Fit,
    /// What the last sweep found, at the fit's own values.
    pub found: NormalEquations,
    pub noise: &'r mut Option<OwnedNoise>,
}

/// Answers for all of them.
pub(crate) fn ask_all(fits: &mut [FittedInSweeps<'_, '_>], quantity: Quantity) {
    let values: Vec<[f64; 3]> = fits.iter_mut().map(FittedInSweeps::values).collect();
    let inquiries: Vec<ScoreCovariance> = (fits.iter())
        .map(|fit| ScoreCovariance::new(fit.residual, fit.task, fit.fit))
        .collect();
    let mut score_sums: Vec<ScoreSums> = fits.iter().map(FittedInSweeps::at_hand).collect();
    for search in [LevenbergMarquardt::Scores, LevenbergMarquardt::Source] {
        let places: Vec<usize> = (0..fits.len())
            .filter(|&place| search.is_asked_by(&inquiries[place]))
            .collect();
        let swept: Vec<Swept<'_, '_>> = (places.iter())
            .map(|&place| Swept {
                residual: fits[place].residual,
                acceleration: fits[place].acceleration(),
                values: values[place],
                score_covariance: &inquiries[place],
            })
            .collect();
        for (place, answer) in places.iter().zip(sweep_all(&swept, quantity, search)) {
            let free = fits[*place].residual.free();
            answer.add_to(&mut score_sums[*place], free);
        }
    }
    for ((fit, score_covariance), score_sums) in fits.iter_mut().zip(&inquiries).zip(&score_sums) {
        *fit.noise = Some(score_covariance.conclude(score_sums));
    }
}

impl<'a> FittedInSweeps<'_, 'a> {
    /// m, c, k of the fit.
    fn values(&mut self) -> [f64; 3] {
        let all = self.residual.all_values(&self.fit.values);
        [all[0], all[1], all[2]]
    }

    /// The measured acceleration.
    fn acceleration(&self) -> Option<&'a [f64]> {
        (self.task.tightening.motion).get(Quantity::Acceleration)
    }

    /// What the last sweep of the fit tells already.
    fn at_hand(&self) -> ScoreSums {
        let free = self.residual.free();
        ScoreSums {
            matrix: submatrix_at(&self.found.matrix, free),
            sums: entries_at(&self.found.sums, free),
            ..ScoreSums::default()
        }
    }
}

/// What is looked for in a sweep at the optimum.
#[derive(Clone, Copy)]
enum LevenbergMarquardt {
    Scores,
    Source,
}

impl LevenbergMarquardt {
    fn is_asked_by(self, score_covariance: &ScoreCovariance) -> bool {
        match self {
            Self::Scores => score_covariance.asks_scores(),
            Self::Source => score_covariance.integrated().is_some(),
        }
    }
}

enum Answer {
    /// Stretch by stretch, by m, c, k.
    Scores(Vec<[f64; 3]>),
    /// By m, c, k.
    Source {
        products: [[f64; 3]; 3],
        drift: [f64; 3],
        mean_square: Option<f64>,
    },
}

impl Answer {
    fn add_to(&self, score_sums: &mut ScoreSums, free: &[usize]) {
        match self {
            Self::Scores(scores) => {
                let scores = scores.iter().flat_map(|score| entries_at(score, free));
                score_sums.scores = scores.collect();
            }
            Self::Source {
                products,
                drift,
                mean_square,
            } => {
                score_sums.source = Source {
                    products: submatrix_at(products, free),
                    drift: entries_at(drift, free),
                    mean_square: *mean_square,
                };
            }
        }
    }
}

/// One tightening to be swept once.
struct Swept<'i, 'a> {
    residual: &'i TighteningResidual<'a>,
    acceleration: Option<&'a [f64]>,
    values: [f64; 3],
    score_covariance: &'i ScoreCovariance,
}

impl<'a> Swept<'_, 'a> {
    /// Sweeps of one kind of input take the same steps; integrals are as many in every lane.
    fn kind(&self) -> (usize, i32) {
        let noise = self.score_covariance.integrated();
        let integrations = noise.map_or(0, |noise| noise.integrations);
        (self.residual.substeps(), integrations)
    }

    /// How long work on it lasts: as long as the noise's colour is deep, and as the record.
    fn size(&self) -> (usize, usize) {
        let order = |noise: &IntegratedNoise| noise.whitening.order();
        let colour = self.score_covariance.integrated().map_or(0, order);
        (colour, self.residual.residual_count())
    }

    fn record(&self, search: LevenbergMarquardt) -> ScoredRecord<'a> {
        match search {
            LevenbergMarquardt::Scores => self.residual.scored(),
            LevenbergMarquardt::Source => self.residual.beside(self.acceleration),
        }
    }
}

/// One answer for each, in their order; one by itself needs no vector registers.
fn sweep_all(
    swept: &[Swept<'_, '_>],
    quantity: Quantity,
    search: LevenbergMarquardt,
) -> Vec<Answer> {
    let mut order: Vec<usize> = (0..swept.len()).collect();
    order.sort_by_key(|&place| (swept[place].kind(), swept[place].size()));
    let mut answers: Vec<(usize, Answer)> = Vec::new();
    for alike in order.chunk_by(|&one, &other| swept[one].kind() == swept[other].kind()) {
        let task = SideBySide {
            swept: alike.iter().map(|&place| &swept[place]).collect(),
            quantity,
            search,
        };
        let found = match alike {
            [_] => task.run(0.0),
            _ => in_lanes(task),
        };
        answers.extend(alike.iter().copied().zip(found));
    }
    answers.sort_by_key(|(place, _)| *place);
    answers.into_iter().map(|(_, answer)| answer).collect()
}

struct SideBySide<'s, 'i, 'a> {
    swept: Vec<&'s Swept<'i, 'a>>,
    quantity: Quantity,
    search: LevenbergMarquardt,
}

impl LaneTask for SideBySide<'_, '_, '_> {
    type Output = Vec<Answer>;
    fn run<R: Real>(self, zero: R) -> Vec<Answer> {
        let mut answers = Vec::new();
        let mut values = vec![[0.0; 3]; R::LANES];
        let substeps = self.swept[0].kind().0;
        let mut sweep = Sweep::new(zero, self.quantity, substeps);
        let (mut residual, mut rows) = (Vec::new(), Vec::new());
        for group in self.swept.chunks(R::LANES) {
            (group.len()..R::LANES).for_each(|lane| sweep.unload(lane));
            for (lane, one) in group.iter().enumerate() {
                sweep.load(lane, one.record(self.search));
                values[lane] = one.values;
            }
            match self.search {
                LevenbergMarquardt::Scores => {
                    let found = sweep.scores(&values, STRETCHES).into_iter();
                    answers.extend(found.map(Answer::Scores).take(group.len()));
                }
                LevenbergMarquardt::Source => {
                    sweep.course(&values, &mut residual, &mut rows);
                    answers.extend(at_source(zero, &residual, &mut rows, group));
                }
            }
        }
        answers
    }
}

/// What is found at the source of integrated noise.
fn at_source<R: Real>(
    zero: R,
    residual: &[R],
    rows: &mut [[R; 3]],
    group: &[&Swept<'_, '_>],
) -> Vec<Answer> {
    let noises: Vec<_> = (group.iter())
        .filter_map(|one| one.score_covariance.integrated())
        .collect();
    for (lane, one) in group.iter().enumerate() {
        let unscored = one.residual.samples() - one.residual.residual_count();
        for entry in rows[..unscored].as_flattened_mut() {
            entry.lanes_mut()[lane] = 0.0;
        }
    }
    let Some(first) = noises.first() else {
        return Vec::new();
    };
    let each =
        |of: &dyn Fn(usize) -> Option<f64>| zero.lane_by_lane(|lane| of(lane).unwrap_or(0.0));
    let order = |lane: usize| Some(noises.get(lane)?.whitening.order());
    let longest = (0..noises.len()).filter_map(order).max().unwrap_or(0);
    let coefficient = |lane: usize, lag: usize| {
        let coefficients = noises.get(lane)?.whitening.coefficients();
        coefficients.get(lag).copied()
    };
    let (drift, products, squares) = zero.vectorize(AtSource {
        residual,
        rows,
        interval_s: each(&|lane| Some(noises.get(lane)?.interval_s)),
        integrations: first.integrations,
        autoregression: (0..longest)
            .map(|lag| each(&|lane| coefficient(lane, lag)))
            .collect(),
        scored: [
            each(&|lane| Some(order(lane)? as f64)),
            each(&|lane| Some(group.get(lane)?.residual.samples() as f64)),
        ],
    });
    (group.iter().zip(noises).enumerate())
        .map(|(lane, (one, noise))| {
            let of = |values: [R; 3]| values.map(|value| value.lanes()[lane]);
            let count = one
                .residual
                .samples()
                .saturating_sub(noise.whitening.order());
            let whole = count as f64 * noise.whitening.innovation_sd().powi(2);
            let mean = (count > 0).then(|| squares.lanes()[lane] / whole);
            Answer::Source {
                products: products.map(of),
                drift: of(drift),
                mean_square: one.acceleration.and(mean),
            }
        })
        .collect()
}

/// One walk from the last sample to the first.
struct AtSource<'a, R> {
    /// Of the acceleration.
    residual: &'a [R],
    /// J.
    rows: &'a mut [[R; 3]],
    interval_s: R,
    integrations: i32,
    autoregression: Vec<R>,
    /// First sample whose past is whole, and number of samples.
    scored: [R; 2],
}

impl<R: Real> Task for AtSource<'_, R> {
    /// Drift, the inner products at the source, and the square of the filtered acceleration residual.
    type Output = ([R; 3], [[R; 3]; 3], R);
    #[inline(always)]
    fn run(self) -> Self::Output {
        let (h, integrations, residual) = (self.interval_s, self.integrations, self.residual);
        let autoregression = &self.autoregression[..];
        let [begin, end] = self.scored;
        let zero = h.constant(0.0);
        let (mut drifted, mut squares) = ([zero; 3], zero);
        let (mut mm, mut mc, mut mk) = (zero, zero, zero);
        let (mut cc, mut ck, mut kk) = (zero, zero, zero);
        to_source(
            self.rows,
            h,
            integrations,
            autoregression,
            #[inline(always)]
            |t, given, &[m, c, k]| {
                let wrong = drift(t, h, integrations);
                for (sum, s) in drifted.iter_mut().zip(given) {
                    *sum += *s * wrong;
                }
                mm += m * m;
                mc += m * c;
                mk += m * k;
                cc += c * c;
                ck += c * k;
                kk += k * k;
                let mut white = residual[t];
                for (a, earlier) in autoregression.iter().zip(residual[..t].iter().rev()) {
                    white += *a * *earlier;
                }
                let now = h.constant(t as f64);
                let kept = R::choose(end.is_above(now), white, zero);
                let kept = R::choose(begin.is_above(now), zero, kept);
                squares += kept * kept;
            },
        );
        (drifted, [[mm, mc, mk], [mc, cc, ck], [mk, ck, kk]], squares)
    }
}
