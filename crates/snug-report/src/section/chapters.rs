//! Reading order of the page: compare, where it fails, what is missing, before and after, the ladder; then the rest.

use super::{
    Section, before_after, comparison, conditions, corrections, detectability, deviations,
    distributions, effort, findings, glossary, identifiability, ladder, location, overview,
    p_values, ranking, selection, study, tightening_figures, tightening_table, torque, validation,
    verdict,
};

/// Sections that belong together: one entry of the page's navigation.
pub struct Chapter {
    /// Stable name within the page's address.
    pub anchor: &'static str,
    /// What the navigation calls it; all of them fit on a line.
    pub title: &'static str,
    /// Its sections, in reading order.
    pub(super) sections: &'static [Section],
}

/// Every chapter; one that a result has nothing for is left out.
pub(super) const CHAPTERS: &[Chapter] = &[
    Chapter {
        anchor: "result",
        title: "Result",
        sections: &[overview::SECTION],
    },
    Chapter {
        anchor: "compare",
        title: "Compare",
        sections: &[comparison::SECTION],
    },
    Chapter {
        anchor: "fails",
        title: "Where it fails",
        sections: &[location::SECTION],
    },
    Chapter {
        anchor: "missing",
        title: "What is missing",
        sections: &[verdict::SECTION, ranking::SECTION],
    },
    Chapter {
        anchor: "gain",
        title: "Before and after",
        sections: &[before_after::SECTION],
    },
    Chapter {
        anchor: "rungs",
        title: "Ladder",
        sections: &[ladder::SECTION, detectability::SECTION],
    },
    Chapter {
        anchor: "each",
        title: "Tightenings",
        sections: &[
            validation::SECTION,
            selection::SECTION,
            tightening_figures::SECTION,
            tightening_table::SECTION,
            identifiability::SECTION,
            corrections::SECTION,
        ],
    },
    Chapter {
        anchor: "groups",
        title: "Conditions",
        sections: &[
            conditions::SECTION,
            p_values::SECTION,
            distributions::SECTION,
            torque::SECTION,
        ],
    },
    Chapter {
        anchor: "background",
        title: "Background",
        sections: &[
            findings::SECTION,
            deviations::SECTION,
            study::SECTION,
            glossary::SECTION,
            effort::SECTION,
        ],
    },
];
