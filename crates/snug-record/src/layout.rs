//! A ready layout for the viewers Foxglove and Lichtblick (`snug-layout.json`).

use crate::topic;
use serde_json::{Map, Value, json};

const RED: &str = "#c0392b";
const ORANGE: &str = "#e69138";
const BLUE: &str = "#1f77b4";
const GREEN: &str = "#2ca02c";
const GREY: &str = "#7f7f7f";

/// The layout as JSON, to be imported in the viewer: four tabs.
///
/// - *Tightening*: torque; displacement and acceleration, measured against simulated; residual; forces; the estimate.
/// - *Parameters*: each of `parameters` (names as in the estimates, for example `mass_kg`) over the recording's time.
/// - *Campaign*: tests, conditions, findings.
/// - *Missing effect*: the verdict, the error ladder, the candidates (empty when nobody asked for a diagnosis).
pub fn layout(parameters: &[&str]) -> String {
    let tabs = [
        ("Tightening", tightening_tab()),
        ("Parameters", parameters_tab(parameters)),
        ("Campaign", campaign_tab()),
        ("Missing effect", diagnosis_tab()),
    ];
    let mut panels = Map::new();
    let mut placed = Vec::new();
    for (title, tab) in tabs {
        panels.extend(tab.panels);
        placed.push(json!({"title": title, "layout": tab.layout}));
    }
    let tab = json!({"activeTabIdx": 0, "tabs": placed});
    panels.insert("Tab!snug".into(), tab);
    let layout = json!({
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 0.1},
        "layout": "Tab!snug",
    });
    format!("{layout:#}")
}

/// A part of a tab: how its panels stand, by their ids, and the settings of each.
struct Part {
    layout: Value,
    panels: Map<String, Value>,
}

fn tightening_tab() -> Part {
    let parameters = format!("{}.parameters[:]", topic::ESTIMATE);
    let tables = [
        table("parameters", "Parameters", &parameters),
        raw("estimate", "Estimate", topic::ESTIMATE),
        raw("window", "Tightening", topic::WINDOW),
    ];
    let plots = split(
        "row",
        column(motion_plots()),
        column(difference_plots()),
        50.0,
    );
    split("row", plots, column(tables), 70.0)
}

/// A line over the samples of a tightening.
fn signal(path: &str, label: &str, color: &str) -> Value {
    series(&format!("{}.{path}", topic::SIGNALS), label, color, true)
}

/// Torque, displacement and acceleration, measured against simulated.
fn motion_plots() -> [Part; 3] {
    let motion = |quantity: &str| {
        vec![
            signal(&format!("measured.{quantity}"), "measured", BLUE),
            signal(&format!("before.{quantity}"), "before", ORANGE),
            signal(&format!("simulated.{quantity}"), "simulated", RED),
        ]
    };
    let torque = vec![signal("measured.torque_nm", "torque", BLUE)];
    let mut displacement = motion("displacement_rad");
    displacement.push(signal("simulated.euler_displacement_rad", "Euler", GREY));
    let acceleration = motion("acceleration_rad_per_s2");
    [
        plot("torque", "Torque [N m]", torque),
        plot("displacement", "Displacement [rad]", displacement),
        plot("acceleration", "Acceleration [rad/s²]", acceleration),
    ]
}

/// Residuals and forces.
fn difference_plots() -> [Part; 3] {
    let residual = |quantity: &str| {
        let path = format!("residual.{quantity}");
        vec![signal(&path, "measured − simulated", RED)]
    };
    let forces = vec![
        signal("forces.force_f1_n", "F1", RED),
        signal("forces.force_f2_n", "F2", BLUE),
        signal("forces.force_f3_n", "F3", GREEN),
        signal("forces.grip_force_n", "F_op_J", GREY),
    ];
    [
        plot(
            "residual",
            "Residual of the acceleration [rad/s²]",
            residual("acceleration_rad_per_s2"),
        ),
        plot(
            "residual_displacement",
            "Residual of the displacement [rad]",
            residual("displacement_rad"),
        ),
        plot("forces", "Force between tool and hand [N]", forces),
    ]
}

fn parameters_tab(parameters: &[&str]) -> Part {
    let parameter = |name: &&str| {
        let line = |end: &str, label: &str, color: &str| {
            let path = format!(
                "{}.parameters[:]{{name==\"{name}\"}}.{end}",
                topic::ESTIMATE
            );
            series(&path, label, color, false)
        };
        let lines = vec![
            line("value", name, BLUE),
            line("low", "low", GREY),
            line("high", "high", GREY),
        ];
        plot(&format!("parameter_{name}"), name, lines)
    };
    let measure = |name: &str, title: &str| {
        let path = format!("{}.measures.{name}", topic::ESTIMATE);
        plot(name, title, vec![series(&path, name, BLUE, false)])
    };
    let mut plots: Vec<Part> = parameters.iter().map(parameter).collect();
    plots.push(measure("error_over_noise", "Error over noise"));
    plots.push(measure("fit_percent", "Fit [%]"));
    column(plots)
}

fn campaign_tab() -> Part {
    let rows = |topic: &str| format!("{topic}.rows[:]");
    let tables = [
        table("tests", "Tests", &rows(topic::TESTS)),
        table("conditions", "Conditions", &rows(topic::CONDITIONS)),
    ];
    let settings = json!({"searchTerms": [], "minLogLevel": 1, "topicToRender": topic::LOG});
    // The log panel's type keeps its historical name.
    let log = panel("RosOut", "findings", "Findings", settings);
    split("row", column(tables), log, 60.0)
}

fn diagnosis_tab() -> Part {
    let rung = |name: &str, label: &str, color: &str| {
        series(&format!("{}.{name}", topic::LADDER), label, color, true)
    };
    let errors = vec![
        rung("error_over_noise", "all tightenings", BLUE),
        rung("heldout_error_over_noise", "held out", RED),
    ];
    let gain = format!("{}.heldout_gain", topic::RANKING);
    let plots = [
        plot(
            "ladder",
            "Error over noise, model by model (1 = nothing but noise)",
            errors,
        ),
        plot(
            "selected",
            "Share of tightenings selected, model by model",
            vec![rung("selected_fraction", "selected", GREEN)],
        ),
        plot(
            "ranking",
            "Share of the misfit that each candidate removes",
            vec![series(&gain, "misfit removed, held out", BLUE, false)],
        ),
    ];
    let messages = [
        raw("verdict", "Verdict", topic::VERDICT),
        raw("rung", "Rung", topic::LADDER),
        raw("candidate", "Candidate", topic::RANKING),
    ];
    split("row", column(plots), column(messages), 55.0)
}

fn series(value: &str, label: &str, color: &str, line: bool) -> Value {
    json!({
        "value": value,
        "label": label,
        "color": color,
        "enabled": true,
        "timestampMethod": "receiveTime",
        "showLine": line,
        "lineSize": if line { 1.5 } else { 4.0 },
    })
}

fn plot(id: &str, title: &str, paths: Vec<Value>) -> Part {
    let settings = json!({
        "paths": paths,
        "showXAxisLabels": true,
        "showYAxisLabels": true,
        "showLegend": true,
        "legendDisplay": "floating",
        "showPlotValuesInLegend": false,
        "isSynced": true,
        "xAxisVal": "timestamp",
        "sidebarDimension": 240,
    });
    panel("Plot", id, title, settings)
}

fn table(id: &str, title: &str, path: &str) -> Part {
    panel("Table", id, title, json!({"topicPath": path}))
}

fn raw(id: &str, title: &str, path: &str) -> Part {
    let settings = json!({
        "topicPath": path,
        "diffEnabled": false,
        "diffMethod": "custom",
        "diffTopicPath": "",
        "showFullMessageForDiff": false,
    });
    panel("RawMessages", id, title, settings)
}

fn panel(kind: &str, id: &str, title: &str, mut settings: Value) -> Part {
    let id = format!("{kind}!{id}");
    settings["foxglovePanelTitle"] = title.into();
    settings["lichtblickPanelTitle"] = title.into();
    Part {
        layout: id.as_str().into(),
        panels: Map::from_iter([(id, settings)]),
    }
}

/// Parts of equal height below each other.
fn column(parts: impl IntoIterator<Item = Part>) -> Part {
    let mut parts: Vec<Part> = parts.into_iter().collect();
    let mut column = parts.pop().expect("a column has at least one part");
    let mut count = 1.0;
    while let Some(above) = parts.pop() {
        count += 1.0;
        column = split("column", above, column, 100.0 / count);
    }
    column
}

fn split(direction: &str, first: Part, second: Part, percent: f64) -> Part {
    let layout = json!({
        "direction": direction,
        "first": first.layout,
        "second": second.layout,
        "splitPercentage": percent,
    });
    let panels = first.panels.into_iter().chain(second.panels).collect();
    Part { layout, panels }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::encoding::schema::{Kind, Message};

    fn leaves(layout: &Value, found: &mut Vec<String>) {
        match layout {
            Value::String(id) => found.push(id.clone()),
            Value::Object(split) => {
                leaves(&split["first"], found);
                leaves(&split["second"], found);
            }
            other => panic!("{other} is neither a panel nor a split"),
        }
    }

    #[test]
    fn every_panel_is_placed_once() {
        let layout: Value =
            serde_json::from_str(&layout(&["mass_kg", "k3_n_per_m3"])).expect("the layout is JSON");
        let panels = layout["configById"].as_object().expect("an object");
        let mut placed = vec![layout["layout"].as_str().expect("one panel").to_owned()];
        for tab in panels["Tab!snug"]["tabs"].as_array().expect("a list") {
            leaves(&tab["layout"], &mut placed);
        }
        placed.sort();
        let mut known: Vec<String> = panels.keys().cloned().collect();
        known.sort();
        assert_eq!(placed, known);
    }

    /// Follows `a.b[:]{…}.c` through a message's table.
    fn exists(message: &Message, path: &str) -> bool {
        let mut kind = Kind::Group(message.fields);
        for part in path.split('.') {
            let name = part.split('[').next().unwrap_or_default();
            let Kind::Group(fields) = kind else {
                return false;
            };
            let Some(field) = fields.iter().find(|field| field.name == name) else {
                return false;
            };
            if field.listed != part.contains("[:]") {
                return false;
            }
            kind = field.kind;
        }
        true
    }

    #[test]
    fn every_path_leads_to_a_field() {
        let messages = [
            (topic::SIGNALS, &crate::messages::signals::SIGNALS),
            (topic::ESTIMATE, &crate::messages::estimate::ESTIMATE),
            (topic::WINDOW, &crate::messages::window::WINDOW),
            (topic::TESTS, &crate::messages::statistics::TESTS),
            (topic::CONDITIONS, &crate::messages::statistics::CONDITIONS),
            (topic::LOG, &crate::messages::finding::LOG),
            (topic::LADDER, &crate::messages::diagnosis::LADDER),
            (topic::RANKING, &crate::messages::diagnosis::RANKING),
        ];
        let layout: Value =
            serde_json::from_str(&layout(&["mass_kg"])).expect("the layout is JSON");
        let mut paths = Vec::new();
        for config in layout["configById"]
            .as_object()
            .expect("an object")
            .values()
        {
            for key in ["topicPath", "topicToRender"] {
                paths.extend(config[key].as_str().map(str::to_owned));
            }
            for series in config["paths"].as_array().into_iter().flatten() {
                paths.push(series["value"].as_str().expect("text").to_owned());
            }
        }
        assert!(paths.len() > 20, "only {} paths", paths.len());
        // The verdict's schema is made from the message itself, and the layout shows it whole.
        paths.retain(|path| path != topic::VERDICT);
        for path in paths {
            let (topic, field) = path.split_once('.').unwrap_or((&path, ""));
            let (_, message) = messages
                .iter()
                .find(|(name, _)| *name == topic)
                .unwrap_or_else(|| panic!("no topic {topic}"));
            assert!(field.is_empty() || exists(message, field), "{path}");
        }
    }
}
