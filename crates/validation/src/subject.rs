//! List of comparisons.

use crate::page::Page;
use crate::{
    closed_forms, contact_bem, finite_elements, fretting_load, impact_theory, measured_impact,
    oblique_loading, restitution, stick_slip,
};
use stickslip_contact::{ContactError, FirstLoadingError, FrictionError, MaterialError, ProfileError};
use stickslip_drive::RunError;
use stickslip_run::Watcher;
use stickslip_scenario::ScenarioError;
use thiserror::Error;

/// A known result with which the program is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// Measured oblique impacts.
    MeasuredImpact,
    /// Boundary-element program CONTACT.
    ContactBem,
    /// Rate equations of Mindlin and Deresiewicz.
    ObliqueLoading,
    /// Theory of oblique impact.
    ImpactTheory,
    /// Oblique impacts by finite elements.
    FiniteElements,
    /// Measured fretting with a varying normal load.
    FrettingLoad,
    /// Closed forms of loading, unloading and hysteresis loops.
    ClosedForms,
    /// Closed form of stick-slip on a belt.
    Belt,
    /// Measured stick-slip of a slider on a spring.
    MeasuredSlider,
    /// Coefficients of restitution by another integration.
    Restitution,
}

/// Reason why a page cannot be computed.
#[derive(Debug, Error)]
pub enum ValidationError {
    /// A run stopped early.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A scenario of this crate is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A data file of this crate is invalid.
    #[error(transparent)]
    Data(#[from] serde_json::Error),
    /// A material of this crate is invalid.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A coefficient of friction of this crate is invalid.
    #[error(transparent)]
    Friction(#[from] FrictionError),
    /// A profile of this crate is invalid.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// A loading of this crate is invalid.
    #[error(transparent)]
    Loading(#[from] FirstLoadingError),
    /// A path of this crate is invalid.
    #[error(transparent)]
    Path(#[from] ContactError),
    /// A scenario of this crate has no free ball.
    #[error("the scenario has no free ball")]
    NoBall,
}

impl Subject {
    /// All comparisons in the order of the index.
    pub const ALL: [Self; 10] = [
        Self::MeasuredImpact,
        Self::ContactBem,
        Self::ObliqueLoading,
        Self::ImpactTheory,
        Self::FiniteElements,
        Self::FrettingLoad,
        Self::ClosedForms,
        Self::Belt,
        Self::MeasuredSlider,
        Self::Restitution,
    ];

    /// Returns the name of the page's files, without extension.
    pub fn name(self) -> &'static str {
        match self {
            Self::MeasuredImpact => measured_impact::NAME,
            Self::ContactBem => contact_bem::NAME,
            Self::ObliqueLoading => oblique_loading::NAME,
            Self::ImpactTheory => impact_theory::NAME,
            Self::FiniteElements => finite_elements::NAME,
            Self::FrettingLoad => fretting_load::NAME,
            Self::ClosedForms => closed_forms::NAME,
            Self::Belt => stick_slip::BELT,
            Self::MeasuredSlider => stick_slip::SLIDER,
            Self::Restitution => restitution::NAME,
        }
    }

    /// Computes the page. The watcher may interrupt.
    ///
    /// # Errors
    /// Fails if a run stops early or the watcher interrupts.
    pub fn page(self, watcher: &dyn Watcher) -> Result<Page, ValidationError> {
        match self {
            Self::MeasuredImpact => measured_impact::page(watcher),
            Self::ContactBem => contact_bem::page(),
            Self::ObliqueLoading => oblique_loading::page(),
            Self::ImpactTheory => impact_theory::page(watcher),
            Self::FiniteElements => finite_elements::page(watcher),
            Self::FrettingLoad => fretting_load::page(watcher),
            Self::ClosedForms => closed_forms::page(),
            Self::Belt => stick_slip::belt(),
            Self::MeasuredSlider => stick_slip::slider(),
            Self::Restitution => restitution::page(),
        }
    }
}
