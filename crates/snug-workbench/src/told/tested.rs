//! Whether an effect is real, as tightenings say that it was not fitted to.

use crate::campaign::Campaign;
use serde_json::{Value, json};
use snug_campaign::words::chance::{by_chance, share_with_error};
use snug_campaign::words::program::program;
use snug_diagnose::HeldOut;
use snug_model::Effect;

/// That a test is under way; `is_last` of the effect that came in last.
pub(crate) fn testing(campaign: &Campaign, effect: &str, is_last: bool) -> Value {
    let sentence = format!(
        "Is {} real? Testing it on tightenings it was not fitted to …",
        campaign.called(effect)
    );
    json!({
        "kind": "tested",
        "effect": effect,
        "state": "testing",
        "short": "being tested …",
        "is_last": is_last,
        "sentence": campaign.says(&sentence),
    })
}

/// What came of it.
pub(crate) fn tested(
    campaign: &Campaign,
    effect: &str,
    tested: Option<&HeldOut>,
    is_last: bool,
) -> Value {
    let name = campaign.called(effect);
    let evidence = tested.map(|tested| campaign.says(&evidence(&name, tested)));
    let (state, sentence) = match tested {
        None => (
            "unsure",
            format!(
                "{name} cannot be simulated beside the others from its usual start: it is not tested."
            ),
        ),
        Some(tested) => verdict(campaign, &name, tested),
    };
    json!({
        "kind": "tested",
        "effect": effect,
        "state": state,
        "short": short(state),
        "is_last": is_last,
        "sentence": campaign.says(&sentence),
        "evidence": evidence,
    })
}

/// The same in a word or two.
fn short(state: &str) -> &'static str {
    match state {
        "real" => "tested: real",
        "twins" => "tested: it or a twin",
        _ => "tested: not sure",
    }
}

fn verdict(campaign: &Campaign, name: &str, tested: &HeldOut) -> (&'static str, String) {
    let called = |effect: &Effect| campaign.called(effect.name());
    match &tested.better {
        // A law that is in no catalogue has no switch.
        Some(Effect::Custom(law)) if !campaign.switches.contains(&Effect::Custom(law)) => {
            let expression = &law.settings().expression;
            let told = format!(
                "Tested: a law that is in no catalogue, {expression}, takes plainly more than {name}; the command {} improve tries \
                 such laws.",
                program()
            );
            return ("unsure", told);
        }
        Some(better) => {
            let better = called(better);
            let told =
                format!("Tested: {better} takes plainly more than {name}; try it in its place.");
            return ("unsure", told);
        }
        None => {}
    }
    if !tested.is_supported {
        let why = match tested.is_told_from_nothing {
            true => "what it takes may be chance",
            false => "its size is not told from nothing",
        };
        return ("unsure", format!("Tested, and not supported: {why}."));
    }
    match tested.twins.is_empty() {
        true => ("real", format!("Tested: {name} is real.")),
        false => {
            let twins: Vec<String> = tested.twins.iter().map(called).collect();
            (
                "twins",
                format!(
                    "Tested: something is really missing; it is {name} or {}, these data cannot tell which.",
                    twins.join(" or ")
                ),
            )
        }
    }
}

fn evidence(name: &str, tested: &HeldOut) -> String {
    let (campaigns, alarms) = tested.false_alarms;
    let control = match campaigns {
        0 => String::new(),
        _ => {
            format!(" Of {campaigns} campaigns of nothing but noise {alarms} raised a false alarm.")
        }
    };
    format!(
        "In tightenings it was not fitted to, {name} takes {} of what is left beyond the noise without it; among {} candidates {}.{control}",
        share_with_error(tested.share, tested.share_error),
        tested.family,
        by_chance(tested.p_family),
    )
}
