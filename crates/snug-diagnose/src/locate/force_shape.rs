//! What the missing force follows: the sign of the velocity, the angle's cube, …
//!
//! A force f(x, v) that the model lacks leaves the residual with which the base model answers to the torque −l f along the
//! measured motion (the simulated one where x or v is not measured): its signature z, whitened like the residual w. Both
//! are freed of what m, c and k can take up to first order (their sensitivities). With s = Σ ⟨z, w⟩ over tightenings, one
//! shape of one size explains s² / Σ ⟨z, z⟩ of the excess. All shapes together predict a tightening with the sizes that the tightenings of other files ask for; with
//! that prediction p, Σ (2 ⟨p, w⟩ − ⟨p, p⟩) over the excess is the share that comes back.

use super::residual::{Residuals, White};
use crate::locate::thresholds::{ENOUGH_FILES, FADING_M_PER_S, NO_NEWS, SPANNED};
use rayon::prelude::*;
use snug_campaign::{Intersample, Motion, Quantity};
use snug_identify::Whitening;
use snug_model::{BASE_PARAMETERS, Input, Model};
use std::collections::BTreeMap;

/// Number of shapes.
const COUNT: usize = 6;

type Shape = fn(f64, f64) -> f64;

/// What a force over x and v can look like, in words.
const SHAPES: [(&str, Shape); COUNT] = [
    ("the sign of the velocity, as dry friction does", |_, v| {
        (v / FADING_M_PER_S).tanh()
    }),
    ("v|v|, as a damper does that grows with speed", |_, v| {
        v * v.abs()
    }),
    (
        "x², as a spring does that is stiffer to one side",
        |x, _| x * x,
    ),
    (
        "x³, as a spring does that stiffens (or softens) the further it is pushed",
        |x, _| x * x * x,
    ),
    (
        "x² v, as a damper does that grows with the displacement",
        |x, v| x * x * v,
    ),
    ("x v, as a damper does that differs to each side", |x, v| {
        x * v
    }),
];

/// What all shapes say about the misfit.
#[derive(Default)]
pub struct Followed {
    /// Each shape with the share of the excess that it explains alone, best first.
    pub shapes: Vec<(&'static str, f64)>,
    /// Share of the excess that the shapes predict from other files (other tightenings, with fewer than three files).
    pub predicted: Option<f64>,
}

/// One tightening's ⟨z, z⟩ and ⟨z, w⟩, and its ‖w‖² without the noise's.
struct Sums {
    gram: [[f64; COUNT]; COUNT],
    along: [f64; COUNT],
    excess: f64,
    file: String,
}

/// Nothing where the misfit is not beyond the noise.
pub fn followed(residuals: &Residuals<'_>) -> Followed {
    if !residuals.beyond_noise {
        return Followed::default();
    }
    let sums: Vec<Sums> = residuals
        .all
        .par_iter()
        .filter_map(|one| sums(one, residuals))
        .collect();
    let excess: f64 = sums.iter().map(|own| own.excess).sum();
    if excess <= 0.0 {
        return Followed::default();
    }
    let floor = if residuals.noise_known { 1.0 } else { 0.0 };
    let mut shapes: Vec<(&str, f64)> = SHAPES
        .iter()
        .enumerate()
        .map(|(index, (shape, _))| {
            let along: f64 = sums.iter().map(|own| own.along[index]).sum();
            let size: f64 = sums.iter().map(|own| own.gram[index][index]).sum();
            let gain = if size > 0.0 {
                along * along / size
            } else {
                0.0
            };
            (*shape, ((gain - floor) / excess).clamp(0.0, 1.0))
        })
        .collect();
    shapes.sort_by(|a, b| b.1.total_cmp(&a.1));
    Followed {
        shapes,
        predicted: predicted(&sums).map(|gain| gain / excess),
    }
}

/// Σ (2 ⟨p, w⟩ − ⟨p, p⟩) with the sizes of every file's shapes taken from the others; `None` for one tightening.
fn predicted(sums: &[Sums]) -> Option<f64> {
    let mut files: BTreeMap<&str, Vec<&Sums>> = BTreeMap::new();
    for own in sums {
        files.entry(&own.file).or_default().push(own);
    }
    let folds: Vec<Vec<&Sums>> = if files.len() >= ENOUGH_FILES {
        files.into_values().collect()
    } else {
        sums.iter().map(|own| vec![own]).collect()
    };
    if folds.len() < 2 {
        return None;
    }
    let folds: Vec<_> = folds
        .iter()
        .map(|fold| total(fold.iter().copied()))
        .collect();
    let all = total(sums.iter());
    let gains = folds.iter().map(|(gram, along)| {
        let others = std::array::from_fn(|i| std::array::from_fn(|j| all.0[i][j] - gram[i][j]));
        let sizes = solve(others, std::array::from_fn(|i| all.1[i] - along[i]));
        (0..COUNT)
            .map(|i| {
                let inner: f64 = (0..COUNT).map(|j| gram[i][j] * sizes[j]).sum();
                sizes[i] * (2.0 * along[i] - inner)
            })
            .sum::<f64>()
    });
    Some(gains.sum())
}

type Normal = ([[f64; COUNT]; COUNT], [f64; COUNT]);

fn total<'a>(sums: impl Iterator<Item = &'a Sums>) -> Normal {
    let mut total: Normal = Default::default();
    for own in sums {
        for i in 0..COUNT {
            total.1[i] += own.along[i];
            for j in 0..COUNT {
                total.0[i][j] += own.gram[i][j];
            }
        }
    }
    total
}

/// Least squares from scaled normal equations by elimination, largest diagonal first; shapes without news get 0.
fn solve(mut gram: [[f64; COUNT]; COUNT], mut along: [f64; COUNT]) -> [f64; COUNT] {
    let scale: [f64; COUNT] = std::array::from_fn(|i| gram[i][i].max(0.0).sqrt());
    let inverse = scale.map(|s| if s > 0.0 { 1.0 / s } else { 0.0 });
    for (i, row) in gram.iter_mut().enumerate() {
        along[i] *= inverse[i];
        for (value, other) in row.iter_mut().zip(inverse) {
            *value *= inverse[i] * other;
        }
    }
    let mut open: Vec<usize> = (0..COUNT).collect();
    let mut done = [false; COUNT];
    while let Some(position) =
        (0..open.len()).max_by(|&a, &b| gram[open[a]][open[a]].total_cmp(&gram[open[b]][open[b]]))
    {
        let pivot = open.swap_remove(position);
        if gram[pivot][pivot] < NO_NEWS {
            break;
        }
        done[pivot] = true;
        // Gauss–Jordan: the pivot's row and column leave every other equation.
        let (row, right) = (gram[pivot], along[pivot]);
        for i in (0..COUNT).filter(|&i| i != pivot) {
            let factor = gram[i][pivot] / row[pivot];
            for (value, other) in gram[i].iter_mut().zip(row) {
                *value -= factor * other;
            }
            along[i] -= factor * right;
        }
    }
    std::array::from_fn(|i| match done[i] {
        true => inverse[i] * along[i] / gram[i][i],
        false => 0.0,
    })
}

fn sums(one: &White<'_>, residuals: &Residuals<'_>) -> Option<Sums> {
    let seen = &one.seen;
    let tightening = seen.tightening;
    let l = tightening.rig.lever_arm_m;
    let [m, c, k] = BASE_PARAMETERS.map(|name| seen.estimate.value(name));
    let values = [m?, c?, k?];
    let model = Model::new(tightening.rig, &[]).ok()?;
    let both = |motion: &'_ Motion| {
        Some((
            motion.displacement_rad.clone()?,
            motion.velocity_rad_per_s.clone()?,
        ))
    };
    let (angle, velocity) = both(&tightening.motion).or_else(|| both(seen.simulated))?;
    let whiten = Whiten::of(one, residuals);
    let answer = |torque: &[f64]| {
        let interval_s = tightening.time_base.interval_s;
        Input::new(torque, interval_s, Intersample::Linear)
    };
    let logged = answer(&tightening.torque_nm);
    let taken = taken_up(&model, &values, &logged, residuals.quantity, &whiten)?;
    let mut output = vec![0.0; tightening.torque_nm.len()];
    let signatures = SHAPES.map(|(_, shape)| {
        let torque: Vec<f64> = angle
            .iter()
            .zip(&velocity)
            .map(|(angle, velocity)| -l * shape(l * angle, l * velocity))
            .collect();
        let input = answer(&torque);
        (model.output(&values, &input, residuals.quantity, &mut output)).ok()?;
        let mut signature = whiten.signal(&output);
        free_of(&mut signature, &taken);
        Some(signature)
    });
    let signatures: Vec<Vec<f64>> = signatures.into_iter().collect::<Option<_>>()?;
    let mut residual = one.values.clone();
    free_of(&mut residual, &taken);
    let floor = if residuals.noise_known {
        (residual.len() - taken.len().min(residual.len())) as f64
    } else {
        0.0
    };
    let sums = Sums {
        gram: std::array::from_fn(|i| std::array::from_fn(|j| dot(&signatures[i], &signatures[j]))),
        along: std::array::from_fn(|i| dot(&signatures[i], &residual)),
        excess: dot(&residual, &residual) - floor,
        file: tightening.id.file.clone(),
    };
    let finite = sums
        .along
        .iter()
        .chain(sums.gram.iter().flatten())
        .all(|s| s.is_finite());
    finite.then_some(sums)
}

/// Orthonormal directions of the whitened residual that a change of m, c and k can take up.
fn taken_up(
    model: &Model,
    values: &[f64],
    input: &Input,
    quantity: Quantity,
    whiten: &Whiten,
) -> Option<Vec<Vec<f64>>> {
    let samples = input.samples();
    let (mut output, mut slopes) = (vec![0.0; samples], vec![0.0; 3 * samples]);
    let all = &[0, 1, 2];
    (model.sensitivities(values, all, input, quantity, &mut output, &mut slopes)).ok()?;
    let mut taken: Vec<Vec<f64>> = Vec::new();
    for slope in slopes.chunks_exact(samples) {
        let mut direction = whiten.signal(slope);
        let before = dot(&direction, &direction);
        // Twice, because once leaves rounding of the long part in the short one.
        free_of(&mut direction, &taken);
        free_of(&mut direction, &taken);
        let norm = dot(&direction, &direction);
        if norm > SPANNED * before {
            direction.iter_mut().for_each(|d| *d /= norm.sqrt());
            taken.push(direction);
        }
    }
    Some(taken)
}

/// What makes a signal comparable with a tightening's whitened residual.
struct Whiten {
    whitening: Option<Whitening>,
    scale: f64,
    unscored: usize,
    count: usize,
}

impl Whiten {
    fn of(one: &White<'_>, residuals: &Residuals<'_>) -> Self {
        let noise = one.seen.tightening.noise.as_ref();
        Self {
            whitening: noise
                .filter(|_| residuals.noise_known)
                .and_then(Whitening::new),
            scale: residuals.scale,
            unscored: one.seen.unscored,
            count: one.values.len(),
        }
    }

    fn signal(&self, signal: &[f64]) -> Vec<f64> {
        let scored = signal.get(self.unscored..).unwrap_or_default();
        let mut white = vec![0.0; self.count];
        match &self.whitening {
            Some(whitening) => whitening.apply(scored, &mut white),
            None => white
                .iter_mut()
                .zip(scored)
                .for_each(|(white, value)| *white = value * self.scale),
        }
        white
    }
}

fn free_of(signal: &mut [f64], directions: &[Vec<f64>]) {
    for direction in directions {
        let along = dot(signal, direction);
        for (value, d) in signal.iter_mut().zip(direction) {
            *value -= along * d;
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
