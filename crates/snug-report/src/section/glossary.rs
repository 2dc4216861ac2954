//! Explains what the page calls things, and what T and θ stand for on a rig that is no nutrunner.

use super::{Render, Section};
use maud::{Markup, html};
use snug_campaign::CampaignResult;
use snug_campaign::words::program::program;

/// Terms, symbols and units.
pub const SECTION: Section = Section {
    anchor: "glossary",
    short_title: "Glossary",
    title: "Terms, symbols and units",
    render: Render::Always(render),
};

/// Each with its meaning; `{program}` stands for what people type.
const TERMS: &[(&str, &str)] = &[
    (
        "Tightening",
        "One run of the tool on one bolt: torque builds up, then drops, and the tool kicks the hand.",
    ),
    (
        "Model",
        "The hand and arm as a mass m on a spring k and a damper c at the grip, l from the joint's axis: x = l θ, v = l ω, \
         F = k x + c v (plus effects), (Iₙ + m l²) dω/dt = T − l F.",
    ),
    (
        "Hand–arm mass m [kg], damping c [kg/s], stiffness k [N/m]",
        "What is identified from every tightening.",
    ),
    (
        "Tool inertia Iₙ [kg m²], lever arm l [m]",
        "Known constants of the rig.",
    ),
    (
        "Natural frequency fₙ [Hz]",
        "√(k/m)/2π of the hand–arm alone.",
    ),
    (
        "Damped frequency [Hz], damping ratio ζ",
        "Of tool and hand–arm together; ζ below 1 is lightly damped.",
    ),
    (
        "Angle θ [rad], velocity ω [rad/s], acceleration α [rad/s²]",
        "Motion of the tool about the joint's axis; x = l θ is the grip's displacement [m].",
    ),
    ("Torque T [Nm]", "Measured at the joint; the model's input."),
    (
        "F1, F2, F3 [N]",
        "Force between tool and hand: F1 = l (c ω + k θ) from the model's spring and damper; F2 = (T − Iₙ α)/l with the measured, F3 with the simulated acceleration.",
    ),
    (
        "F_op_J [N]",
        "The measured grip force, where a transducer is mounted.",
    ),
    ("Residual", "Measured minus simulated."),
    (
        "Fit [%]",
        "100 (1 − ‖y − ŷ‖/‖y − ȳ‖), y measured, ŷ simulated: 100 is perfect, 0 no better than the mean.",
    ),
    (
        "Error over noise",
        "Root mean square of the residual in multiples of the measurement noise: 1 means nothing is left but noise.",
    ),
    (
        "Effect",
        "A physical law that the model can have beyond mass, damper and spring; “{program} effects” lists them.",
    ),
    ("Misfit", "What of the residual is more than the noise."),
    (
        "Held out, unseen",
        "Tightenings that took no part in finding an effect's size. What helps there, too, is a law and no accident.",
    ),
    (
        "Chance, p",
        "How often chance alone would do as well, all candidates taken together: 0.05 is 5 of 100 times.",
    ),
    (
        "Twins, not to be told from",
        "Effects that explain these data equally well; the bench or further tightenings must decide.",
    ),
    (
        "Euler method",
        "The explicit Euler displacement of the original program; its accuracy is 100 (1 − mean |e| / mean |y|) %.",
    ),
    (
        "95 % interval [low, high]",
        "Would hold the true value in 95 of 100 repetitions, if the model is right.",
    ),
    (
        "Standard deviation (SD)",
        "How much single tightenings differ, not how sure their mean is.",
    ),
    (
        "QS, TT",
        "Tightening strategies Quick Step and Turbo Tight.",
    ),
];

fn render(result: &CampaignResult) -> Markup {
    html! {
        dl.glossary { @for (term, meaning) in TERMS { dt { (term) } dd { (meaning.replace("{program}", program())) } } }
        @if !result.units.mechanical() {
            p.note {
                "The source declares its input in " (result.units.input) " and its output in " (result.units.output)
                ": in the formulas above they stand for T and θ."
            }
        }
        p.note { "Decimal points throughout; units are SI unless they stand beside the number." }
    }
}
