//! The thesis' file layout: which variables a file holds and how they are called.

use crate::files::file::SyntheticFile;
use crate::files::mat5::{MatValue, mat5};
use crate::plan::file::ChannelNames;
use serde::{Deserialize, Serialize};
use std::io;

/// How numbers stand in a MAT file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MatStyle {
    /// Whether each variable is compressed; default yes.
    pub compressed: bool,
    /// Whether channels are written in double precision; default no: single.
    pub double_precision: bool,
}

impl Default for MatStyle {
    fn default() -> Self {
        Self {
            compressed: true,
            double_precision: false,
        }
    }
}

impl ChannelNames {
    /// Acceleration, torque, force.
    pub(crate) fn names(self) -> [&'static str; 3] {
        match self {
            Self::Plain => ["angle_acc_Acc_FIR150", "Inline_Torque", "F_op_J"],
            Self::Inline => ["angle_acc_Acc_FIR150", "Inline", "F_op_J"],
            Self::Data1 => [
                "Data1_angle_acc_Acc_FIR150",
                "Data1_Inline",
                "Data1_F_op_J_FIR_Filter_OFFSET",
            ],
        }
    }
}

impl SyntheticFile {
    /// The file as a MAT file of level 5 in the thesis' layout.
    ///
    /// # Errors
    /// Never in practice: everything is written to memory.
    pub fn mat(&self, style: MatStyle) -> io::Result<Vec<u8>> {
        let [acceleration, torque, force] = self.plan.channel_names.names();
        let column = |samples| {
            if style.double_precision {
                MatValue::Double(samples)
            } else {
                MatValue::Single(samples)
            }
        };
        let label = self.plan.label();
        let mut variables = vec![
            ("File_name", MatValue::Text(&label)),
            ("Events", self.events()),
            (acceleration, column(&self.acceleration_rad_per_s2)),
            (torque, column(&self.torque_nm)),
        ];
        if let Some(samples) = &self.grip_force_n {
            variables.push((force, column(samples)));
        }
        mat5(&variables, style.compressed)
    }

    /// Three rows per tightening: number, what happens, time with a decimal comma.
    fn events(&self) -> MatValue<'static> {
        let mut texts = Vec::new();
        let what = ["Start", "Torque", "Stop"].into_iter().cycle();
        for ((number, time_s), what) in (1..).zip(self.events_s.iter().flatten()).zip(what) {
            let time = format!("{time_s:.4}").replace('.', ",");
            texts.extend([format!("{number}"), what.to_owned(), time]);
        }
        MatValue::CellOfText { columns: 3, texts }
    }
}
