//! Labels of the thesis, of other studies and of neither, and templates that cannot be.

use super::*;

fn pattern(template: &str) -> ConditionPattern {
    ConditionPattern {
        template: Template::try_from(template.to_owned()).expect("well formed"),
        ..ConditionPattern::default()
    }
}

fn words(conditions: &Conditions) -> (Option<&str>, Option<&str>, Option<&str>, Option<f64>) {
    (
        conditions.participant.as_deref(),
        conditions.strategy.as_deref(),
        conditions.joint.as_deref(),
        conditions.pace_per_min,
    )
}

#[test]
fn labels_of_the_thesis_layout() {
    let pattern = ConditionPattern::default();
    for (label, participant, strategy, joint, pace) in [
        ("TP3_QS_Soft_8", "TP3", "QS", "Soft", 8.0),
        ("TP1_QS_Soft_5_01", "TP1", "QS", "Soft", 5.0),
        ("TP6_tt_HARD_8-rerun", "TP6", "TT", "Hard", 8.0),
        ("TP_6_TT_Hard_8.5", "TP_6", "TT", "Hard", 8.5),
        (" Anna Öst_QS_hard_5,5 ", "Anna Öst", "QS", "Hard", 5.5),
        ("TP2_QS_Hard_8.mat", "TP2", "QS", "Hard", 8.0),
        // A participant whose name holds a strategy's word.
        ("QS_QS_TT_Soft_12", "QS_QS", "TT", "Soft", 12.0),
    ] {
        let conditions = pattern.conditions(label).expect(label);
        let expected = (Some(participant), Some(strategy), Some(joint), Some(pace));
        assert_eq!(words(&conditions), expected, "{label}");
    }
}

#[test]
fn labels_that_say_something_else_give_nothing() {
    let pattern = ConditionPattern::default();
    for label in [
        "",
        "measurement 7",
        "TP3_QS_Soft",
        "TP3_QS_Soft_fast",
        "TP3_QS_Sofd_8",
        "_QS_Soft_8",
        "TP3QSSoft8",
    ] {
        assert_eq!(pattern.conditions(label), None, "{label}");
    }
}

#[test]
fn a_misspelt_word_costs_its_own_field_only() {
    let mut log = FindingLog::new("x.mat".as_ref());
    let conditions = ConditionPattern::default().read(&["TP3_QS_Sofd_8"], &mut log);
    assert_eq!(
        words(&conditions),
        (Some("TP3"), Some("QS"), None, Some(8.0))
    );
    let findings = log.finish();
    assert_eq!(findings.len(), 1);
    assert!(findings[0].message.contains("Sofd") && findings[0].message.contains("Soft, Hard"));
}

#[test]
fn the_second_label_helps_out() {
    let mut log = FindingLog::new("x.mat".as_ref());
    let conditions = ConditionPattern::default().read(&["run 4", "TP3_TT_Hard_8"], &mut log);
    assert_eq!(
        words(&conditions),
        (Some("TP3"), Some("TT"), Some("Hard"), Some(8.0))
    );
    assert!(log.finish().is_empty());
}

#[test]
fn templates_of_other_studies() {
    let pattern = ConditionPattern {
        joints: Vec::new(),
        ..pattern("Run{skip} {joint}-joint {strategy} p{pace} {participant}")
    };
    let conditions = pattern
        .conditions("run17 M6x20-Joint TT P10 anna")
        .expect("follows");
    assert_eq!(
        words(&conditions),
        (Some("anna"), Some("TT"), Some("M6x20"), Some(10.0))
    );
}

#[test]
fn templates_that_cannot_be() {
    for template in [
        "{person}_{pace}",
        "{joint}{pace}",
        "{joint}_{joint}",
        "{joint",
        "joint}",
    ] {
        assert!(
            Template::try_from(template.to_owned()).is_err(),
            "{template}"
        );
    }
}
