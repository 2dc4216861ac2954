//! The page: what is there before anything is clicked. What changes, the script fills in from what the server tells.

use crate::campaign::Campaign;
use maud::{Markup, PreEscaped, html};
use serde_json::{Value, json};
use snug_campaign::words::effect_name::{effect_name, raised};
use snug_campaign::words::{capitalised, counted};
use snug_model::Effect;
use snug_report::viewer::{SCRIPT, document, viewer};

const OWN_STYLE: &str = include_str!("assets/workbench.css");
const OWN_SCRIPT: &str = include_str!("assets/workbench.js");
const READING_SCRIPT: &str = include_str!("assets/reading.js");

fn around(title: &str, content: &Markup, script: &[&str]) -> Markup {
    let body = html! {
        (content)
        script { @for part in script { (PreEscaped(part)) } }
    };
    document(&format!("{title} – Snug workbench"), OWN_STYLE, &body)
}

/// Where tightenings cannot be worked on; of a stretch of every window, with the address of `whole` ones.
pub(crate) fn failed(sentence: &str, whole: Option<&str>) -> Markup {
    let content = html! {
        main.waiting {
            p.kind { "Snug workbench" }
            h1 { "There is nothing to work on" }
            p.lead role="alert" { (capitalised(sentence)) }
            @if let Some(address) = whole { p { a href=(address) { "To whole windows" } } }
        }
    };
    around("Nothing to work on", &content, &[])
}

/// While tightenings are read; `root` is what its addresses begin with.
pub(crate) fn reading(sentence: &str, root: &str) -> Markup {
    let content = html! {
        main.waiting data-root=(root) {
            p.kind { "Snug workbench" }
            h1 { "Reading the tightenings" }
            p.lead data-sentence="" aria-live="polite" { (sentence) }
        }
    };
    around("Reading", &content, &[READING_SCRIPT])
}

/// The workbench on tightenings that are read.
pub(crate) fn working(campaign: &Campaign, root: &str) -> Markup {
    let count = campaign.prepared.live.tasks().len();
    let content = html! {
        a.skip href="#catalogue" { "Skip to the effects" }
        header.bench-head {
            p.kind { "Snug workbench" }
            h1 { (campaign.title) }
            p.note { (counted(count, "tightening")) " from " (counted(campaign.prepared.files, "file")) ", fitted together" (campaign.stretch) }
        }
        p.fault role="alert" data-fault="" hidden {}
        main.bench data-root=(root) {
            (present(campaign))
            (catalogue(campaign))
            (centre(campaign))
            (changed())
        }
        (bar())
    };
    around(&campaign.title, &content, &[SCRIPT, OWN_SCRIPT])
}

/// The error in large type, and the ladder of models.
fn present(campaign: &Campaign) -> Markup {
    html! {
        section.present aria-labelledby="error-title" {
            h2 id="error-title" { "Error" }
            p.error { output data-error="" { "…" } " " span.unit { (campaign.error_unit) } }
            p.steps data-steps="" aria-hidden="true" {}
            p.says data-says="" aria-live="polite" {}
            p.tested data-tested="" aria-live="polite" {}
            p.note data-evidence="" {}
            h3 { "Models so far" }
            ol.ladder data-ladder="" {}
        }
    }
}

/// Every effect as a switch.
fn catalogue(campaign: &Campaign) -> Markup {
    html! {
        section.catalogue id="catalogue" aria-labelledby="catalogue-title" {
            h2 id="catalogue-title" { "Effects" }
            p.note { "Switch one on, and all tightenings are fitted together with it. Sorted by promise: the share of what is left over that a \
                first look says it takes. A promise sorts; only the fit says what it keeps." }
            ul.switches data-switches="" {
                @for &effect in &campaign.switches { (switch(campaign, effect)) }
            }
        }
    }
}

fn switch(campaign: &Campaign, effect: Effect) -> Markup {
    let description = campaign.description(effect);
    let label = format!("effect-{}", effect.name());
    html! {
        li.effect data-effect=(effect.name()) {
            button.switch type="button" role="switch" aria-checked="false" aria-labelledby=(label) { span.knob {} }
            div.about {
                div.line {
                    strong id=(label) { (effect_name(effect.name())) }
                    span.promise data-promise="" title="promise: share of what the model to begin with leaves beyond the noise" { "" }
                }
                span.track { span.fill data-fill="" {} }
                p { (raised(description.summary)) }
                p.found data-sizes="" {}
                p.real data-real="" {}
                button.quiet type="button" aria-pressed="false" data-signature="" title="what it would leave, drawn beside the residual" { "show in residual" }
                details {
                    summary { "check at the bench" }
                    p { (raised(description.check)) }
                    p.note { "How it shows: " (raised(description.shows_as)) }
                }
            }
        }
    }
}

/// One tightening: measured, before and now, and what is left over.
fn centre(campaign: &Campaign) -> Markup {
    let nothing = |panels: &[&str]| {
        let panel = |title| json!({ "title": title, "axis": "", "series": [], "residual": false });
        let example =
            json!({ "step": 1, "unit": "ms", "steps": [0, 1], "signals": [], "noise": null });
        let panels: Vec<Value> = panels.iter().map(panel).collect();
        json!({ "panels": panels, "examples": [example] })
    };
    let of_it = [
        "Model and measurement",
        "What is left over: measured − simulated",
    ];
    let of_step = ["Step response"];
    let tasks = campaign.prepared.live.tasks();
    html! {
        section.centre aria-labelledby="centre-title" {
            h2.hidden id="centre-title" { "One tightening" }
            div.chooser {
                button type="button" data-worse="-1" aria-label="previous tightening" { "‹" }
                label { span.hidden { "tightening, worst first" }
                    select data-tightening="" {
                        @for &member in &campaign.worst_first {
                            option value=(member + 1) data-groups=(groups_of(campaign, member)) { (tasks[member].tightening.id) }
                        }
                    }
                }
                button type="button" data-worse="1" aria-label="next tightening" { "›" }
            }
            (closer(campaign))
            p.current data-heading="" aria-live="polite" { "…" }
            (viewer("viewer-data", &nothing(&of_it), &of_it))
            (viewer("step-data", &nothing(&of_step), &of_step))
            section.force aria-labelledby="force-title" {
                h3 id="force-title" { "The missing force, whether the rest is noise, and the response over frequency" }
                p.note data-cells-say="" hidden { "Click a cell of the map, or go there with the arrows and press Enter, and candidates are ranked by what is left \
                    over there." }
                div data-force="" aria-live="off" {}
            }
            p.help { "Point at a curve to read values; drag across to zoom, double-click to see all again. Keys in a figure: ← → move the \
                cursor, + − zoom, Esc shows all." }
        }
    }
}

/// Which tightenings, and which stretch of time, count for the promises.
fn closer(campaign: &Campaign) -> Markup {
    html! {
        div.closer {
            label { "look at "
                select data-group="" {
                    option value="" { "all tightenings" }
                    @for group in &campaign.groups { option value=(group.key) { (group.name) } }
                }
            }
            button.quiet type="button" data-brush="" disabled { "rank by the stretch shown" }
            button.quiet type="button" data-alone="" disabled title="what comes before it is simulated and not scored, what comes after it is left off" { "fit the stretch shown alone" }
            button.quiet type="button" data-everything="" hidden { "back to everything" }
            button.quiet type="button" data-whole="" hidden { "fit whole windows again" }
        }
        p.note data-closer="" aria-live="polite" {}
    }
}

/// The keys of the groups that a tightening is in, with bars around each.
fn groups_of(campaign: &Campaign, member: usize) -> String {
    let own = campaign
        .groups
        .iter()
        .filter(|group| group.members.contains(&member));
    own.fold("|".to_owned(), |keys, group| keys + &group.key + "|")
}

/// What the last click changed.
fn changed() -> Markup {
    html! {
        section.changed aria-labelledby="changed-title" {
            h2 id="changed-title" { "What the last click changed" }
            p.change data-change="" { "Nothing yet." }
            p.note data-usable="" {}
            dl.sizes data-found="" {}
            div.rival data-rival="" hidden {
                h3 { "Against the rival" }
                p data-rival-name="" {}
                p data-rival-says="" {}
                ul data-rival-sizes="" {}
            }
            h3 { "This tightening" }
            div.scroll tabindex="0" role="region" aria-label="mass, damping and stiffness of this tightening" { table {
                thead { tr { th scope="col" { "" } th scope="col" { "before" } th scope="col" { "now" } th scope="col" data-rival-column="" hidden { "rival" } } }
                tbody data-facts="" {}
            } }
            p.note { "With 95 % intervals." }
            h3 { "Your own values" }
            p.note { "Drag a number of the present model and see this tightening follow. The mark is the fitted value, the bar its 95 % interval." }
            div.sliders data-sliders="" {}
            p.by-hand data-by-hand="" aria-live="polite" {}
            p.buttons {
                button.quiet type="button" data-from-here="" disabled { "fit from here" }
                button.quiet type="button" data-as-fitted="" disabled { "back to the fit" }
            }
        }
    }
}

/// Undo, redo, save.
fn bar() -> Markup {
    html! {
        footer.bar {
            button type="button" data-undo="" disabled { "Undo" }
            button type="button" data-redo="" disabled { "Redo" }
            button type="button" data-pin="" aria-pressed="false" { "Pin as rival" }
            button type="button" data-save="" { "Save as study" }
            button type="button" data-results="" { "Report and recording" }
            p.saved data-saved="" aria-live="polite" {}
            p.saved data-links="" aria-live="polite" {}
        }
    }
}
