//! Held-out squares against refits worked out by hand, and what a fit says of itself.

use super::*;
use crate::data::cases::{Cases, Tally};
use crate::pooled::fit::fit_effects;
use crate::tests::made_up::{NOISE, SAMPLES, WHOLE, close, custom_force, exact, hand, noisy, term};
use snug_campaign::{Factor, Level, Tightening};
use snug_identify::FitTask;
use snug_model::BASE_PARAMETERS;
use snug_model::Effect::{CubicStiffness, InitialMotion, TorqueOffset};

/// Three tightenings of one residual each, y = 1, 2, 6 about one shared mean α = 3: r = y − α, ∂r/∂α = −1.
fn mean_of_three() -> Fitted {
    Fitted::made_up(&[CubicStiffness], &[4.0, 1.0, 9.0], 1).with_shared(
        ("k3_n_per_m3", 3, 3.0),
        &[(1.0, 2.0), (1.0, 1.0), (1.0, -3.0)],
    )
}

fn agree(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    found
        .iter()
        .zip(expected)
        .for_each(|(a, b)| close(*a, *b, 1e-12));
}

/// The means without each are 4, 3.5 and 1.5.
#[test]
fn what_is_held_out_is_judged_by_the_size_that_the_others_give() {
    let heldout = mean_of_three().heldout(&|cluster| cluster);
    agree(&heldout, &[9.0, 2.25, 20.25]);
}

/// Without the first two the mean is 6, without the third 1.5.
#[test]
fn a_group_is_held_out_together() {
    let heldout = mean_of_three().heldout(&|cluster| cluster / 2);
    agree(&heldout, &[25.0, 16.0, 20.25]);
}

/// Each parameter that a tightening has of its own hides two units of chance, 2 · 14/3 here: Mallows' Cp.
#[test]
fn sizes_of_its_own_cost_a_tightening_what_they_hide() {
    let fitted = mean_of_three().with_own(&["bias_rad_per_s2"], vec![vec![0.0]; 3], 1);
    let pays = 28.0 / 3.0;
    let expected = [9.0 + pays, 2.25 + pays, 20.25 + pays];
    agree(&fitted.heldout(&|cluster| cluster), &expected);
}

#[test]
fn what_torque_noise_makes_is_no_misfit() {
    let fitted = mean_of_three().with_torque_noise(&[1.0, 0.25, 20.0]);
    agree(&fitted.heldout_beyond_torque_noise(), &[8.0, 2.0, 0.25]);
}

/// Two records y = β + α t with three stretches of one residual each: t = −1, 0, 1 with y = 0, 1, 5, and t = −2, 0, 2 with
/// y = −3, 0, 3. All together: β = 2 and 0, α = (5 + 12) / (2 + 8) = 1.7.
fn two_lines() -> Fitted {
    let times = [-1.0, 0.0, 1.0, -2.0, 0.0, 2.0];
    let residuals = [-0.3, -1.0, 1.3, 0.4, 0.0, -0.4];
    let squares: Vec<f64> = residuals.iter().map(|r| r * r).collect();
    let mut fitted = Fitted::made_up(&[CubicStiffness], &squares, 1).with_own(
        &["mass_kg"],
        vec![vec![2.0], vec![0.0]],
        0,
    );
    for (block, (t, r)) in fitted.blocks.iter_mut().zip(times.iter().zip(residuals)) {
        block.gradient = vec![-r, -t * r];
        block.curvature = SymmetricMatrix::new(2, vec![1.0, *t, *t, t * t]);
    }
    fitted.members = vec![0, 0, 0, 1, 1, 1];
    fitted.clusters = Clusters { per_case: 3 };
    fitted.shared = vec![1.7];
    fitted.shared_of = vec![vec![0]; 2];
    fitted.shared_names = vec!["k3_n_per_m3".to_owned()];
    let of_squares = |squares| SymmetricMatrix::new(2, vec![3.0, 0.0, 0.0, squares]);
    fitted.member_curvature = vec![of_squares(2.0), of_squares(8.0)];
    let profile = |curvature, gradient| (SymmetricMatrix::new(1, vec![curvature]), vec![gradient]);
    fitted.profiles = vec![profile(2.0, -1.6), profile(8.0, 1.6)];
    fitted
}

/// Without (1, 5) the first record says β = ½ + ½ α and, with the second, α = (½ + 12) / (½ + 8) = 25/17: 46/17 where 5 is.
/// Without (0, 1) the slope stays, and β = 5/2.
#[test]
fn a_stretch_is_held_out_of_its_own_record_and_of_what_all_share() {
    let heldout = two_lines().heldout(&|cluster| cluster);
    close(heldout[2], (39.0_f64 / 17.0).powi(2), 1e-12);
    close(heldout[1], 1.5 * 1.5, 1e-12);
}

/// Where β is how a record begins it stays: without (1, 5) all others say of α a ninth of −1.3 more, and 1.3 + 1.3/9 is left.
#[test]
fn how_a_record_begins_is_not_held_out_with_its_stretches() {
    let mut begins = two_lines();
    begins.effects = vec![InitialMotion, CubicStiffness];
    begins.own_indices = vec![BASE_PARAMETERS.len()];
    let heldout = begins.heldout(&|cluster| cluster);
    close(heldout[2], (13.0_f64 / 9.0).powi(2), 1e-12);
    close(heldout[1], 1.0, 1e-12);
}

/// What the stretches of both pull at α, whose β are in their middle: −t r.
#[test]
fn stretches_of_several_records_speak_of_what_they_share() {
    let (curvature, gradients) = two_lines().shared_evidence();
    assert_eq!((curvature.size(), curvature.at(0, 0)), (1, 10.0));
    let expected = [-0.3, 0.0, -1.3, 0.8, 0.0, 0.8];
    for (found, expected) in gradients.iter().zip(expected) {
        close(found[0], expected, 1e-12);
    }
}

/// Moved by 3 in t, a record says the same of its slope: what is asked of the middle is not asked of the slope.
#[test]
fn what_a_stretch_asks_of_its_own_record_is_no_pull_at_what_all_share() {
    let mut moved = two_lines();
    for block in &mut moved.blocks[..3] {
        let (g, t) = (block.gradient[0], block.curvature.at(0, 1) + 3.0);
        block.gradient[1] += 3.0 * g;
        block.curvature = SymmetricMatrix::new(2, vec![1.0, t, t, t * t]);
    }
    moved.member_curvature[0] = SymmetricMatrix::new(2, vec![3.0, 9.0, 9.0, 2.0 + 27.0]);
    let (curvature, gradients) = moved.shared_evidence();
    close(curvature.at(0, 0), 10.0, 1e-12);
    for (found, expected) in gradients.iter().zip([-0.3, 0.0, -1.3, 0.8, 0.0, 0.8]) {
        close(found[0] + 1.0, expected + 1.0, 1e-12);
    }
}

#[test]
fn a_single_record_s_stretches_speak_of_its_own_parameters_too() {
    let two = two_lines();
    let mut one = two.clone();
    one.own.truncate(1);
    one.blocks.truncate(3);
    let (curvature, gradients) = one.shared_evidence();
    assert_eq!((curvature.size(), curvature.at(1, 1)), (2, 2.0));
    assert_eq!(gradients, [[0.3, -0.3], [1.0, 0.0], [-1.3, -1.3]]);
}

/// 4 · 100 residuals less 4 · 3 + 1 parameters are 387.
#[test]
fn the_error_accounts_for_every_parameter() {
    let fitted = Fitted::made_up(&[CubicStiffness], &[387.0; 4], 100)
        .with_own(&["m", "c", "k"], vec![vec![1.0; 3]; 4], 0)
        .with_shared(("k3_n_per_m3", 3, 1.0), &[(1.0, 0.0); 4]);
    close(fitted.error(), 2.0, 1e-12);
    close(fitted.scale(), 3.87, 1e-12);
}

#[test]
fn only_where_the_noise_is_known_can_a_fit_come_down_to_it() {
    let leaving = |error: f64| Fitted::made_up(&[], &[100.0 * error * error; 4], 100);
    assert!(leaving(1.019).is_at_floor() && !leaving(1.019).is_beyond_noise());
    assert!(!leaving(1.021).is_at_floor() && leaving(1.021).is_beyond_noise());
    let unknown = leaving(1.019).unweighted();
    assert!(!unknown.is_at_floor() && !unknown.is_beyond_noise());
    let settings = DiagnoseSettings::default();
    assert_eq!(
        leaving(1.019).smallest_gain(&settings),
        settings.smallest_gain_at_noise
    );
    assert_eq!(
        leaving(1.021).smallest_gain(&settings),
        settings.smallest_gain
    );
}

#[test]
fn a_few_are_spread_from_the_worst_to_the_better() {
    let fitted = Fitted::made_up(&[], &[1.0, 9.0, 4.0, 16.0, 25.0], 1);
    assert_eq!(fitted.spread(2), [4, 2]);
    assert_eq!(fitted.spread(8), [4, 3, 1, 2, 0]);
    // Stretches count for the record they are of: 1 + 9 + 4 against 16 + 25.
    let mut records = Fitted::made_up(&[], &[1.0, 9.0, 4.0, 16.0, 25.0], 1);
    (records.members, records.own) = (vec![1, 1, 1, 0, 0], vec![Vec::new(); 2]);
    assert_eq!(records.spread(8), [0, 1]);
}

#[test]
fn a_parameter_is_superfluous_where_hardly_a_tenth_of_it_is_left() {
    let names = [
        "mass_kg",
        "damping_kg_per_s",
        "stiffness_n_per_m",
        "bias_rad_per_s2",
    ];
    let with =
        |own: [f64; 4]| Fitted::made_up(&[], &[1.0], 1).with_own(&names, vec![own.to_vec()], 1);
    let springless = with([2.0, 90.0, 199.0, 1e-9]);
    let spring = with([2.0, 90.0, 2000.0, 1.0]);
    assert_eq!(springless.makes_superfluous(&[&spring]), 1);
    assert_eq!(spring.makes_superfluous(&[&springless]), 0);
    assert_eq!(
        with([2.0, 90.0, 201.0, 1.0]).makes_superfluous(&[&spring]),
        0
    );
    // A sign is no size.
    assert_eq!(
        with([2.0, 90.0, -2000.0, 1.0]).makes_superfluous(&[&spring]),
        0
    );
}

#[test]
fn mass_damping_and_stiffness_of_a_few_records_are_their_means() {
    let names = ["mass_kg", "damping_kg_per_s", "bias_rad_per_s2"];
    let own = vec![vec![2.0, 90.0, 0.1], vec![4.0, 30.0, 0.2]];
    let mut fitted = Fitted::made_up(&[], &[1.0; 2], 1).with_own(&names, own, 1);
    assert!(
        fitted.base().is_empty(),
        "of many tightenings each has its own"
    );
    fitted.clusters = Clusters { per_case: 12 };
    let expected = [
        ("mass_kg".to_owned(), 3.0),
        ("damping_kg_per_s".to_owned(), 60.0),
    ];
    assert_eq!(fitted.base(), expected);
}

/// Parameters 0 to 2 are m, c, k; the offset comes after the cubic spring's number 3.
#[test]
fn an_effect_s_size_is_that_of_its_own_first_parameter() {
    let fitted = Fitted::made_up(&[CubicStiffness, TorqueOffset], &[1.0], 1)
        .with_shared(("offset_nm", 4, 0.7), &[(1.0, 0.0)]);
    assert_eq!(fitted.size(TorqueOffset), 0.7);
    assert_eq!(fitted.size(CubicStiffness), 0.0, "it was held");
}

fn fit(cases: &[FitTask<'_>], effects: &[Effect], clusters: Clusters) -> Fitted {
    let tally = Tally::default();
    fit_effects(Cases::new(cases, &tally), effects, None, clusters).expect("it can be simulated")
}

#[test]
fn a_fit_begins_where_another_ended_and_what_is_new_as_usual() {
    let cases = [exact(0, &[], &[]), exact(1, &[], &[])];
    let own = vec![vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]];
    let names = ["mass_kg", "damping_kg_per_s", "stiffness_n_per_m"];
    let before = Fitted::made_up(&[CubicStiffness], &[1.0; 2], 1)
        .with_own(&names, own.clone(), 0)
        .with_shared(("k3_n_per_m3", 3, 7e5), &[(1.0, 0.0); 2]);
    let tally = Tally::default();
    let pooled = PooledModel::new(Cases::new(&cases, &tally), &[TorqueOffset, CubicStiffness]);
    let start = before.start(&pooled.expect("the effects go together"));
    assert_eq!(start.own, own);
    assert_eq!(start.shared, [0.0, 7e5]);
}

/// A latch and an end stop both have p and x0: without the latch the stop's are called p and x0, no longer `end_stop_law_p`.
#[test]
fn a_term_begins_where_it_ended_whatever_company_it_is_named_in() {
    let (latch, stop, bent) = (
        term("latch_law"),
        term("end_stop_law"),
        custom_force("bent", "p*x^2", 7.0),
    );
    let cases = [exact(0, &[], &[]), exact(1, &[], &[])];
    let both = fit(&cases, &[latch, stop], WHOLE);
    let [.., p, x0] = both.shared[..] else {
        panic!("four sizes are shared")
    };
    let shared = |effects: &[Effect]| {
        let tally = Tally::default();
        let pooled = PooledModel::new(Cases::new(&cases, &tally), effects);
        let start = both.start(&pooled.expect("the effects go together"));
        assert_eq!(start.own, both.own);
        start.shared
    };
    assert_eq!(shared(&[stop]), [p, x0]);
    assert_eq!(shared(&[bent, stop]), [7.0, p, x0]);
}

#[test]
fn sizes_that_the_data_were_made_with_are_found_without_noise() {
    let cases: Vec<FitTask> = (0..2)
        .map(|n| exact(n, &[CubicStiffness], &[2e6]))
        .collect();
    let fitted = fit(&cases, &[CubicStiffness], WHOLE);
    assert!(fitted.converged && fitted.is_weighted);
    close(fitted.size(CubicStiffness), 2e6, 1e-4);
    for member in 0..2 {
        for ((_, found), truth) in fitted.own_named(member).iter().zip(hand(member)) {
            close(*found, truth, 1e-4);
        }
    }
    assert_eq!(fitted.count(), 2 * SAMPLES);
    assert!(fitted.squares() < 1e-4, "{}", fitted.squares());
}

/// What a cluster holds depends on where it is cut, what all hold together does not; at the optimum their pulls cancel.
#[test]
fn stretches_add_up_to_the_tightening_that_they_are_cut_from() {
    let cases = [noisy(0, &[], &[])];
    let whole = fit(&cases, &[TorqueOffset], WHOLE);
    let cut = fit(&cases, &[TorqueOffset], Clusters { per_case: 6 });
    assert_eq!((cut.blocks.len(), cut.members.as_slice()), (6, &[0; 6][..]));
    assert_eq!(cut.count(), whole.count());
    close(cut.squares(), whole.squares(), 1e-6);
    // Chance of white noise: 250 ± √500, four parameters less.
    assert!(
        (cut.squares() - 246.0).abs() < 5.0 * 500.0_f64.sqrt(),
        "noise of {NOISE}"
    );
    for column in 0..4 {
        let pulls = cut.blocks.iter().map(|block| block.gradient[column]);
        let (sum, sizes) = pulls.fold((0.0, 0.0), |(sum, sizes), g: f64| {
            (sum + g, sizes + g.abs())
        });
        assert!(
            sum.abs() < 1e-3 * sizes,
            "column {column}: {sum} of {sizes}"
        );
    }
}

/// The level of one participant.
fn participant(name: &str) -> Option<Level> {
    let rig = crate::tests::made_up::RIG;
    let mut tightening = Tightening::from_torque(rig, 1e-3, vec![0.0; 3]);
    tightening.conditions.participant = Some(name.to_owned());
    Factor::Participant.level(&tightening)
}

/// y = α of each person: 1, 2, 3 of the first, 10 and 14 of the second. The mean of the others takes the place of one that is
/// held out, and of a person who is held out as a whole the size of the other person.
#[test]
fn of_a_group_the_others_of_it_say_what_one_would_do() {
    let residuals = [-1.0, 0.0, 1.0, -2.0, 2.0_f64];
    let squares: Vec<f64> = residuals.iter().map(|r| r * r).collect();
    let evidence: Vec<(f64, f64)> = residuals.iter().map(|r| (1.0, -r)).collect();
    let mut fitted = Fitted::made_up(&[CubicStiffness], &squares, 1)
        .with_shared(("k3_n_per_m3", 3, 2.0), &evidence);
    let size = |name: &str| SharedSize {
        index: 3,
        level: participant(name),
    };
    fitted.shared_sizes = vec![size("TP1"), size("TP2")];
    fitted.shared_of = vec![vec![0], vec![0], vec![0], vec![1], vec![1]];
    fitted.shared = vec![2.0, 12.0];
    fitted.sharing = Sharing::default().with(CubicStiffness, Some(Factor::Participant));
    let one_out = fitted.heldout(&|cluster| cluster);
    for (found, expected) in one_out.iter().zip([2.25, 0.0, 2.25, 16.0, 16.0]) {
        close(found + 1.0, expected + 1.0, 1e-12);
    }
    let person_out = fitted.heldout(&|cluster| cluster / 3);
    for (found, expected) in person_out.iter().zip([121.0, 100.0, 81.0, 64.0, 144.0]) {
        close(*found, expected, 1e-12);
    }
}
