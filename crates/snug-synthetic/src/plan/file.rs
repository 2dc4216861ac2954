//! The plan of one file: who tightens which joint how, how often, and what its channels are called.

use serde::{Deserialize, Serialize};

/// Tightening strategy; it decides the tool's inertia, since only Quick Step was recorded with the force transducer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Strategy {
    /// Quick Step: changes its speed within the ramp.
    #[serde(rename = "QS")]
    QuickStep,
    /// Turbo Tight: one fast ramp.
    #[serde(rename = "TT")]
    TurboTight,
}

/// Joint stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Joint {
    /// Torque builds up slowly.
    Soft,
    /// Torque builds up fast.
    Hard,
}

/// Which of the thesis' names a file gives its channels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ChannelNames {
    /// `angle_acc_Acc_FIR150`, `Inline_Torque`, `F_op_J`.
    Plain,
    /// `angle_acc_Acc_FIR150`, `Inline`, `F_op_J`.
    Inline,
    /// `Data1_angle_acc_Acc_FIR150`, `Data1_Inline`, `Data1_F_op_J_FIR_Filter_OFFSET`.
    Data1,
}

impl ChannelNames {
    /// The names of the file with this 0-based number: files take turns.
    pub(crate) fn in_turn(file: usize) -> Self {
        [Self::Plain, Self::Inline, Self::Data1][file % 3]
    }
}

/// One file of a campaign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FilePlan {
    /// Number of the participant: 3 gives `TP3`.
    pub participant: u32,
    /// Strategy.
    pub strategy: Strategy,
    /// Joint.
    pub joint: Joint,
    /// Tightenings per minute.
    pub pace_per_min: u32,
    /// Number of tightenings.
    pub tightenings: usize,
    /// Names of the channels.
    pub channel_names: ChannelNames,
}

impl FilePlan {
    /// What the file calls itself, for example `TP3_QS_Soft_8`.
    pub fn label(&self) -> String {
        let Self {
            participant,
            pace_per_min,
            ..
        } = self;
        let (strategy, joint) = (self.strategy_name(), self.joint_name());
        format!("TP{participant}_{strategy}_{joint}_{pace_per_min}")
    }

    /// `QS` or `TT`.
    pub fn strategy_name(&self) -> &'static str {
        match self.strategy {
            Strategy::QuickStep => "QS",
            Strategy::TurboTight => "TT",
        }
    }

    /// `Soft` or `Hard`.
    pub fn joint_name(&self) -> &'static str {
        match self.joint {
            Joint::Soft => "Soft",
            Joint::Hard => "Hard",
        }
    }

    /// I_n: 0.275 kg m² with the force transducer (Quick Step), 0.15 without.
    pub fn known_inertia_kg_m2(&self) -> f64 {
        match self.strategy {
            Strategy::QuickStep => 0.275,
            Strategy::TurboTight => 0.15,
        }
    }
}
