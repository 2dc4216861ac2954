//! One tightening as a page looks at it: under which models, with which numbers, beside which signature.

use crate::bench::{Bench, locked};
use crate::campaign::Campaign;
use crate::changes::EffectSet;
use crate::error::WorkbenchError;
use crate::told;
use serde::Deserialize;
use serde_json::Value;
use snug_diagnose::{LiveFit, LiveTightening};
use snug_report::viewer::Simulated;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Which tightening, under which models.
#[derive(Deserialize)]
pub(crate) struct Look {
    number: usize,
    #[serde(default)]
    effects: String,
    /// The model before; the one to begin with where it is not said.
    before: Option<String>,
    /// A model to hold the present one against.
    rival: Option<String>,
    /// Numbers of the present model, set by hand, with commas between them.
    values: Option<String>,
    /// An effect whose signature is shown beside what is left over.
    signature: Option<String>,
}

/// A model, and the tightening under it.
struct Under {
    fit: Arc<LiveFit>,
    seen: Arc<LiveTightening>,
}

impl Bench {
    /// What a page is told of one tightening.
    pub(crate) fn look(&self, look: &Look) -> Result<Value, WorkbenchError> {
        let campaign = self.campaign()?;
        let member = campaign.member(look.number)?;
        let base_set = campaign.base_set();
        let set = |text: &String| EffectSet::from_address(text);
        let now_set = set(&look.effects);
        let before_set = look.before.as_ref().map_or_else(|| base_set.clone(), set);
        let under = |effects: &EffectSet| self.under(&campaign, effects, member);
        let (first, before, now) = (under(&base_set)?, under(&before_set)?, under(&now_set)?);
        let rival = look
            .rival
            .as_ref()
            .map(|text| under(&set(text)))
            .transpose()?;
        let live = &campaign.prepared.live;
        let values = look.values.as_deref();
        let values = values.map(|text| numbers(text, &now.seen)).transpose()?;
        let by_hand = values.map(|values| live.by_hand(&now.fit, member, &values));
        let by_hand = by_hand.transpose()?;
        let called = (look.signature.as_ref()).map_or_else(String::new, |name| {
            format!("{} would leave", campaign.called(name))
        });
        let signature = match &look.signature {
            None => None,
            Some(name) => {
                let effect = campaign.prepared.named(std::slice::from_ref(name))?[0];
                live.signature(&now.fit, member, effect)?
            }
        };
        let mut models = Vec::new();
        if now_set != base_set {
            models.push(Simulated::first(
                &first.seen.output,
                first.seen.step.as_deref(),
            ));
        }
        models.extend(rival.as_ref().map(|rival| Simulated {
            label: "rival",
            class: "c-rival",
            output: &rival.seen.output,
            step: rival.seen.step.as_deref(),
        }));
        models.push(Simulated::now(&now.seen.output, now.seen.step.as_deref()));
        models.extend(by_hand.as_ref().map(|by_hand| Simulated {
            label: "by hand",
            class: "c-hand",
            output: &by_hand.output,
            step: by_hand.step.as_deref(),
        }));
        let signature_line = signature.as_ref().map(|output| Simulated {
            label: &called,
            class: "c-signature",
            output,
            step: None,
        });
        let mut answer = campaign.compared(member, models, signature_line).json();
        answer["told"] = told::tightening(
            &campaign,
            member,
            [(&before.fit, &before.seen), (&now.fit, &now.seen)],
            rival.as_ref().map(|rival| (&*rival.fit, &*rival.seen)),
            by_hand.as_ref(),
        );
        Ok(answer)
    }

    /// One tightening under a model, which is fitted now where nobody did before.
    fn under(
        &self,
        campaign: &Campaign,
        effects: &EffectSet,
        member: usize,
    ) -> Result<Under, WorkbenchError> {
        let never = AtomicBool::new(false);
        let fit = self.fitted_now(campaign, effects, &never)?;
        let known = locked(&self.looks).get(effects, member);
        let seen = match known {
            Some(seen) => seen,
            None => {
                let seen = Arc::new(campaign.prepared.live.tightening(&fit, member)?);
                locked(&self.looks).keep(effects.clone(), member, Arc::clone(&seen));
                seen
            }
        };
        Ok(Under { fit, seen })
    }

    /// Numbers that were set by hand, one for each of the model.
    pub(crate) fn set_by_hand(
        &self,
        effects: &EffectSet,
        member: usize,
        text: &str,
    ) -> Result<Vec<f64>, WorkbenchError> {
        let campaign = self.campaign()?;
        numbers(text, &self.under(&campaign, effects, member)?.seen)
    }
}

fn numbers(text: &str, seen: &LiveTightening) -> Result<Vec<f64>, WorkbenchError> {
    let count = seen.numbers.len();
    let wrong = || WorkbenchError::NoNumbers {
        given: text.chars().take(120).collect(),
        count,
    };
    let values: Result<Vec<f64>, _> = text.split(',').map(str::parse).collect();
    let values = values.map_err(|_| wrong())?;
    let is_right = values.len() == count && values.iter().all(|value| value.is_finite());
    is_right.then_some(values).ok_or_else(wrong)
}
