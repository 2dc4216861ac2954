//! The noise in base-model fits, asked about for as many tightenings side by side as vector registers hold.

use crate::dense::{chosen, chosen_square};
use crate::integrated_noise::{drift, to_source};
use crate::residual_noise::{Evidence, Inquiry, OwnedNoise, STRETCHES};
use crate::{Fit, Residual, Subject, TighteningResidual, Whitening};
use snug_campaign::Quantity;
use snug_model::{LaneTask, NormalEquations, Real, Sweep, Task, in_lanes};

/// A base-model fit whose noise is asked about.
pub(crate) struct Settled<'r, 'a> {
    pub residual: &'r mut TighteningResidual<'a>,
    pub subject: &'r Subject<'a>,
    pub fit: &'r Fit,
    /// What the last sweep found, at the fit's own values.
    pub found: NormalEquations,
    pub noise: &'r mut Option<OwnedNoise>,
}

/// Answers for all of them.
pub(crate) fn ask_all(fits: &mut [Settled<'_, '_>], quantity: Quantity) {
    let values: Vec<[f64; 3]> = fits.iter_mut().map(Settled::values).collect();
    let mean_squares = mean_squares(fits, &values);
    let inquiries: Vec<Inquiry> = (fits.iter().zip(&mean_squares))
        .map(|(fit, &square)| Inquiry::new(fit.residual, fit.subject, square))
        .collect();
    let mut evidence: Vec<Evidence> = fits.iter().map(Settled::at_hand).collect();
    let which = |asks: fn(&Inquiry) -> bool| -> Vec<usize> {
        let places = 0..inquiries.len();
        places.filter(|&place| asks(&inquiries[place])).collect()
    };
    for (places, search) in [
        (which(Inquiry::asks_scores), Search::Scores),
        (
            which(|inquiry| inquiry.integrated().is_some()),
            Search::Source,
        ),
    ] {
        let swept: Vec<Swept<'_, '_>> = (places.iter())
            .map(|&place| Swept {
                residual: fits[place].residual,
                values: values[place],
                inquiry: Some(&inquiries[place]),
            })
            .collect();
        for (place, answer) in places.iter().zip(sweep_all(&swept, quantity, search)) {
            let free = fits[*place].residual.free();
            answer.add_to(&mut evidence[*place], free);
        }
    }
    for ((fit, inquiry), evidence) in fits.iter_mut().zip(&inquiries).zip(&evidence) {
        *fit.noise = Some(inquiry.conclude(evidence));
    }
}

impl Settled<'_, '_> {
    /// m, c, k of the fit.
    fn values(&mut self) -> [f64; 3] {
        let all = self.residual.all_values(&self.fit.values);
        [all[0], all[1], all[2]]
    }

    /// What the last sweep of the fit tells already.
    fn at_hand(&self) -> Evidence {
        let free = self.residual.free();
        Evidence {
            matrix: chosen_square(&self.found.matrix, free),
            sums: chosen(&self.found.sums, free),
            ..Evidence::default()
        }
    }
}

/// Mean square of the whitened residual of the quantity whose noise is known.
fn mean_squares(fits: &[Settled<'_, '_>], values: &[[f64; 3]]) -> Vec<Option<f64>> {
    let count = |fit: &Settled<'_, '_>| fit.fit.residual_count as f64;
    let mut squares: Vec<Option<f64>> = (fits.iter())
        .map(|fit| {
            Some(fit.fit.sum_of_squares() / count(fit)).filter(|_| fit.residual.is_whitened())
        })
        .collect();
    for quantity in [
        Quantity::Displacement,
        Quantity::Velocity,
        Quantity::Acceleration,
    ] {
        let others: Vec<(usize, Whitening)> = (fits.iter().enumerate())
            .filter(|(_, fit)| !fit.residual.is_whitened())
            .filter_map(|(place, fit)| {
                Some((place, Whitening::of(fit.subject.tightening, quantity)?))
            })
            .collect();
        let residuals: Vec<(usize, TighteningResidual<'_>)> = (others.iter())
            .filter_map(|(place, whitening)| {
                let Subject {
                    model,
                    input,
                    tightening,
                } = *fits[*place].subject;
                let measured = tightening.motion.get(quantity)?;
                let whitening = Some(whitening);
                let residual =
                    TighteningResidual::new(model, input, measured, quantity, whitening, 0);
                (residual.residual_count() > 0).then_some((*place, residual))
            })
            .collect();
        let swept: Vec<Swept<'_, '_>> = (residuals.iter())
            .map(|(place, residual)| Swept {
                residual,
                values: values[*place],
                inquiry: None,
            })
            .collect();
        let found = sweep_all(&swept, quantity, Search::Squares);
        for ((place, residual), answer) in residuals.iter().zip(found) {
            if let Answer::Squares(sum) = answer {
                squares[*place] = Some(sum / residual.residual_count() as f64);
            }
        }
    }
    squares
}

/// What is looked for in a sweep at the optimum.
#[derive(Clone, Copy)]
enum Search {
    Squares,
    Scores,
    Source,
}

enum Answer {
    Squares(f64),
    /// Stretch by stretch, by m, c, k.
    Scores(Vec<[f64; 3]>),
    /// Inner products and drift, by m, c, k.
    Source([[f64; 3]; 3], [f64; 3]),
}

impl Answer {
    fn add_to(&self, evidence: &mut Evidence, free: &[usize]) {
        match self {
            Self::Squares(_) => {}
            Self::Scores(scores) => {
                let scores = scores.iter().flat_map(|score| chosen(score, free));
                evidence.scores = scores.collect();
            }
            Self::Source(products, drift) => {
                evidence.source = (chosen_square(products, free), chosen(drift, free));
            }
        }
    }
}

/// One tightening to be swept once.
struct Swept<'i, 'a> {
    residual: &'i TighteningResidual<'a>,
    values: [f64; 3],
    inquiry: Option<&'i Inquiry>,
}

impl Swept<'_, '_> {
    /// Sweeps of one kind of input take the same steps; integrals are as many in every lane.
    fn kind(&self) -> (usize, i32) {
        let noise = self.inquiry.and_then(Inquiry::integrated);
        let integrations = noise.map_or(0, |noise| noise.integrations);
        (self.residual.substeps(), integrations)
    }
}

/// One answer for each, in their order; one by itself needs no vector registers.
fn sweep_all(swept: &[Swept<'_, '_>], quantity: Quantity, search: Search) -> Vec<Answer> {
    let mut order: Vec<usize> = (0..swept.len()).collect();
    order.sort_by_key(|&place| (swept[place].kind(), swept[place].residual.residual_count()));
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
    search: Search,
}

impl LaneTask for SideBySide<'_, '_, '_> {
    type Output = Vec<Answer>;
    fn run<R: Real>(self, zero: R) -> Vec<Answer> {
        let mut answers = Vec::new();
        let mut values = vec![[0.0; 3]; R::LANES];
        let substeps = self.swept[0].kind().0;
        let mut sweep = Sweep::new(zero, self.quantity, substeps);
        let mut rows = Vec::new();
        for group in self.swept.chunks(R::LANES) {
            let records: Vec<_> = group.iter().map(|one| one.residual.scored()).collect();
            sweep.load(records.iter().enumerate());
            for (values, one) in values.iter_mut().zip(group) {
                *values = one.values;
            }
            (group.len()..R::LANES).for_each(|lane| sweep.unload(lane));
            match self.search {
                Search::Squares => {
                    let found = sweep.run(&values).into_iter();
                    answers.extend(
                        found
                            .map(|found| Answer::Squares(found.squares))
                            .take(group.len()),
                    );
                }
                Search::Scores => {
                    let found = sweep.scores(&values, STRETCHES).into_iter();
                    answers.extend(found.map(Answer::Scores).take(group.len()));
                }
                Search::Source => {
                    sweep.sensitivities(&values, &mut rows);
                    answers.extend(at_source(zero, &mut rows, group));
                }
            }
        }
        answers
    }
}

/// The sensitivities taken back to where integrated noise comes from.
fn at_source<R: Real>(zero: R, rows: &mut [[R; 3]], group: &[&Swept<'_, '_>]) -> Vec<Answer> {
    let noises: Vec<_> = (group.iter())
        .filter_map(|one| one.inquiry?.integrated())
        .collect();
    let Some(first) = noises.first() else {
        return Vec::new();
    };
    let coefficient = |lane: usize, lag: usize| {
        let noise = noises.get(lane)?;
        noise.whitening.coefficients().get(lag).copied()
    };
    let order = noises
        .iter()
        .map(|noise| noise.whitening.order())
        .max()
        .unwrap_or(0);
    let (drift, products) = zero.vectorize(Transposed {
        rows,
        interval_s: zero
            .lane_by_lane(|lane| noises.get(lane).map_or(0.0, |noise| noise.interval_s)),
        integrations: first.integrations,
        autoregression: (0..order)
            .map(|lag| zero.lane_by_lane(|lane| coefficient(lane, lag).unwrap_or(0.0)))
            .collect(),
    });
    (0..group.len())
        .map(|lane| {
            let of = |values: [R; 3]| values.map(|value| value.lanes()[lane]);
            Answer::Source(products.map(of), of(drift))
        })
        .collect()
}

struct Transposed<'a, R> {
    rows: &'a mut [[R; 3]],
    interval_s: R,
    integrations: i32,
    autoregression: Vec<R>,
}

impl<R: Real> Task for Transposed<'_, R> {
    /// Drift, and the inner products at the source.
    type Output = ([R; 3], [[R; 3]; 3]);
    #[inline(always)]
    fn run(self) -> Self::Output {
        let (interval_s, integrations) = (self.interval_s, self.integrations);
        let drift = drift(self.rows, interval_s, integrations);
        to_source(self.rows, interval_s, integrations, &self.autoregression);
        let zero = interval_s.constant(0.0);
        let (mut mm, mut mc, mut mk) = (zero, zero, zero);
        let (mut cc, mut ck, mut kk) = (zero, zero, zero);
        for &mut [m, c, k] in self.rows {
            mm += m * m;
            mc += m * c;
            mk += m * k;
            cc += c * c;
            ck += c * k;
            kk += k * k;
        }
        (drift, [[mm, mc, mk], [mc, cc, ck], [mk, ck, kk]])
    }
}
