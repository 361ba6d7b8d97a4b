//! The list of what is compared.

use crate::page::Page;
use crate::{
    closed_forms, contact_bem, finite_elements, fretting_load, impact_theory, measured_impact,
    oblique_loading,
};
use stickslip_contact::{ContactError, FirstLoadingError, FrictionError, MaterialError, ProfileError};
use stickslip_drive::RunError;
use stickslip_run::Watcher;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// A known result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// Oblique impacts that were measured.
    MeasuredImpact,
    /// The boundary-element program CONTACT.
    ContactBem,
    /// Mindlin and Deresiewicz' rate equations.
    ObliqueLoading,
    /// Oblique impacts in theory.
    ImpactTheory,
    /// Oblique impacts by finite elements.
    FiniteElements,
    /// Fretting under a load that varies, as it was measured.
    FrettingLoad,
    /// Closed forms of loading, unloading and loops.
    ClosedForms,
}

/// Why a page is not there.
#[derive(Debug, Error)]
pub enum ValidationError {
    /// A run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A scenario of this crate.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A file of this crate.
    #[error(transparent)]
    Data(#[from] serde_json::Error),
    /// A material of this crate.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A coefficient of friction of this crate.
    #[error(transparent)]
    Friction(#[from] FrictionError),
    /// A profile of this crate.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// A loading of this crate.
    #[error(transparent)]
    Loading(#[from] FirstLoadingError),
    /// A path of this crate.
    #[error(transparent)]
    Path(#[from] ContactError),
    /// A body that is not in a scenario of this crate.
    #[error("the scenario has no free ball")]
    NoBall,
}

impl Subject {
    /// All of them, in the order of the index.
    pub const ALL: [Self; 7] = [
        Self::MeasuredImpact,
        Self::ContactBem,
        Self::ObliqueLoading,
        Self::ImpactTheory,
        Self::FiniteElements,
        Self::FrettingLoad,
        Self::ClosedForms,
    ];

    /// Name of its page's files, without ending.
    pub fn name(self) -> &'static str {
        match self {
            Self::MeasuredImpact => measured_impact::NAME,
            Self::ContactBem => contact_bem::NAME,
            Self::ObliqueLoading => oblique_loading::NAME,
            Self::ImpactTheory => impact_theory::NAME,
            Self::FiniteElements => finite_elements::NAME,
            Self::FrettingLoad => fretting_load::NAME,
            Self::ClosedForms => closed_forms::NAME,
        }
    }

    /// Computes its page anew. The watcher may end it.
    ///
    /// # Errors
    /// A run that stopped itself, or the watcher's wish.
    pub fn page(self, watcher: &dyn Watcher) -> Result<Page, ValidationError> {
        match self {
            Self::MeasuredImpact => measured_impact::page(watcher),
            Self::ContactBem => contact_bem::page(),
            Self::ObliqueLoading => oblique_loading::page(),
            Self::ImpactTheory => impact_theory::page(watcher),
            Self::FiniteElements => finite_elements::page(watcher),
            Self::FrettingLoad => fretting_load::page(watcher),
            Self::ClosedForms => closed_forms::page(),
        }
    }
}
