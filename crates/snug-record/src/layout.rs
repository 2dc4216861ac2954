//! A ready layout for the viewers Foxglove and Lichtblick (`snug-layout.json`).

use crate::topic;
use serde_json::{Map, Value, json};

const RED: &str = "#c0392b";
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
    let mut panels = Map::new();
    let tightening = tightening_tab(&mut panels);
    let parameters = parameters_tab(&mut panels, parameters);
    let campaign = campaign_tab(&mut panels);
    let diagnosis = diagnosis_tab(&mut panels);
    panels.insert(
        "Tab!snug".into(),
        json!({
            "activeTabIdx": 0,
            "tabs": [
                {"title": "Tightening", "layout": tightening},
                {"title": "Parameters", "layout": parameters},
                {"title": "Campaign", "layout": campaign},
                {"title": "Missing effect", "layout": diagnosis},
            ],
        }),
    );
    let layout = json!({
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 0.1},
        "layout": "Tab!snug",
    });
    format!("{layout:#}")
}

fn tightening_tab(panels: &mut Map<String, Value>) -> Value {
    let left = motion_plots(panels);
    let right = difference_plots(panels);
    let tables = [
        table(
            panels,
            "parameters",
            "Parameters",
            &format!("{}.parameters[:]", topic::ESTIMATE),
        ),
        raw(panels, "estimate", "Estimate", topic::ESTIMATE),
        raw(panels, "window", "Tightening", topic::WINDOW),
    ];
    let plots = split("row", column(&left), column(&right), 50.0);
    split("row", plots, column(&tables), 70.0)
}

/// A line over the samples of a tightening.
fn signal(path: &str, label: &str, color: &str) -> Value {
    series(&format!("{}.{path}", topic::SIGNALS), label, color, true)
}

/// Torque, displacement and acceleration, measured against simulated.
fn motion_plots(panels: &mut Map<String, Value>) -> [Value; 3] {
    let motion = |quantity: &str| {
        vec![
            signal(&format!("measured.{quantity}"), "measured", BLUE),
            signal(&format!("simulated.{quantity}"), "simulated", RED),
        ]
    };
    let mut displacement = motion("displacement_rad");
    displacement.push(signal("simulated.euler_displacement_rad", "Euler", GREY));
    [
        plot(
            panels,
            "torque",
            "Torque [N m]",
            vec![signal("measured.torque_nm", "torque", BLUE)],
        ),
        plot(panels, "displacement", "Displacement [rad]", displacement),
        plot(
            panels,
            "acceleration",
            "Acceleration [rad/s²]",
            motion("acceleration_rad_per_s2"),
        ),
    ]
}

/// Residuals and forces.
fn difference_plots(panels: &mut Map<String, Value>) -> [Value; 3] {
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
            panels,
            "residual",
            "Residual of the acceleration [rad/s²]",
            residual("acceleration_rad_per_s2"),
        ),
        plot(
            panels,
            "residual_displacement",
            "Residual of the displacement [rad]",
            residual("displacement_rad"),
        ),
        plot(panels, "forces", "Force between tool and hand [N]", forces),
    ]
}

fn parameters_tab(panels: &mut Map<String, Value>, parameters: &[&str]) -> Value {
    let mut plots: Vec<Value> = parameters
        .iter()
        .map(|name| {
            let path = |end: &str| {
                format!(
                    "{}.parameters[:]{{name==\"{name}\"}}.{end}",
                    topic::ESTIMATE
                )
            };
            let paths = vec![
                series(&path("value"), name, BLUE, false),
                series(&path("low"), "low", GREY, false),
                series(&path("high"), "high", GREY, false),
            ];
            plot(panels, &format!("parameter_{name}"), name, paths)
        })
        .collect();
    let measure = |name: &str| {
        let value = format!("{}.measures.{name}", topic::ESTIMATE);
        vec![series(&value, name, BLUE, false)]
    };
    plots.push(plot(
        panels,
        "error_over_noise",
        "Error over noise",
        measure("error_over_noise"),
    ));
    plots.push(plot(
        panels,
        "fit_percent",
        "Fit [%]",
        measure("fit_percent"),
    ));
    column(&plots)
}

fn campaign_tab(panels: &mut Map<String, Value>) -> Value {
    let tables = [
        table(
            panels,
            "tests",
            "Tests",
            &format!("{}.rows[:]", topic::TESTS),
        ),
        table(
            panels,
            "conditions",
            "Conditions",
            &format!("{}.rows[:]", topic::CONDITIONS),
        ),
    ];
    // The log panel's type keeps its historical name.
    let log = panel(
        panels,
        "RosOut",
        "findings",
        "Findings",
        json!({"searchTerms": [], "minLogLevel": 1, "topicToRender": topic::LOG}),
    );
    split("row", column(&tables), log, 60.0)
}

fn diagnosis_tab(panels: &mut Map<String, Value>) -> Value {
    let rung = |name: &str, label: &str, color: &str| {
        series(&format!("{}.{name}", topic::LADDER), label, color, true)
    };
    let gain = series(
        &format!("{}.heldout_gain", topic::RANKING),
        "misfit removed, held out",
        BLUE,
        false,
    );
    let plots = [
        plot(
            panels,
            "ladder",
            "Error over noise, model by model (1 = nothing but noise)",
            vec![
                rung("error_over_noise", "all tightenings", BLUE),
                rung("heldout_error_over_noise", "held out", RED),
            ],
        ),
        plot(
            panels,
            "selected",
            "Share of tightenings selected, model by model",
            vec![rung("selected_fraction", "selected", GREEN)],
        ),
        plot(
            panels,
            "ranking",
            "Share of the misfit that each candidate removes",
            vec![gain],
        ),
    ];
    let messages = [
        raw(panels, "verdict", "Verdict", topic::VERDICT),
        raw(panels, "candidate", "Candidate", topic::RANKING),
    ];
    split("row", column(&plots), column(&messages), 55.0)
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

fn plot(panels: &mut Map<String, Value>, id: &str, title: &str, paths: Vec<Value>) -> Value {
    let config = json!({
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
    panel(panels, "Plot", id, title, config)
}

fn table(panels: &mut Map<String, Value>, id: &str, title: &str, path: &str) -> Value {
    panel(panels, "Table", id, title, json!({"topicPath": path}))
}

fn raw(panels: &mut Map<String, Value>, id: &str, title: &str, path: &str) -> Value {
    let config = json!({
        "topicPath": path,
        "diffEnabled": false,
        "diffMethod": "custom",
        "diffTopicPath": "",
        "showFullMessageForDiff": false,
    });
    panel(panels, "RawMessages", id, title, config)
}

/// Keeps the panel's settings and gives its id, which is what a layout's leaves are.
fn panel(
    panels: &mut Map<String, Value>,
    kind: &str,
    id: &str,
    title: &str,
    mut config: Value,
) -> Value {
    let id = format!("{kind}!{id}");
    config["foxglovePanelTitle"] = title.into();
    config["lichtblickPanelTitle"] = title.into();
    panels.insert(id.clone(), config);
    id.into()
}

/// Panels of equal height below each other.
fn column(panels: &[Value]) -> Value {
    match panels {
        [] => Value::Null,
        [panel] => panel.clone(),
        [first, rest @ ..] => {
            let share = 100.0 / panels.len() as f64;
            split("column", first.clone(), column(rest), share)
        }
    }
}

fn split(direction: &str, first: Value, second: Value, percent: f64) -> Value {
    json!({
        "direction": direction,
        "first": first,
        "second": second,
        "splitPercentage": percent,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::schema::{Kind, Message};

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
            (topic::SIGNALS, &crate::signals::SIGNALS),
            (topic::ESTIMATE, &crate::estimate::ESTIMATE),
            (topic::WINDOW, &crate::window::WINDOW),
            (topic::TESTS, &crate::statistics::TESTS),
            (topic::CONDITIONS, &crate::statistics::CONDITIONS),
            (topic::LOG, &crate::finding::LOG),
            (topic::LADDER, &crate::diagnosis::LADDER),
            (topic::RANKING, &crate::diagnosis::RANKING),
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
