//! The documents of a driver: its derivation, the analysis by hand where formulas for it exist, and its scenes.

use linkage_compiler::document::{self, Document, SceneDocument, SheetDocument};
use linkage_compiler::{Lowered, emit};
use linkage_lent::{Lender, Unsound};
use linkage_report::sheet::Sheet;

use crate::failure::Failure;

pub struct Documents {
    driver: Option<Document>,
    by_hand: Option<SheetDocument>,
    scenes: Vec<SceneDocument>,
}

impl Documents {
    pub fn of(of: Lowered) -> Self {
        let (driver, scenes) = emit::documents(&of.program, &of.derivation);
        let signatures = &of.program.signatures;
        let has_formulas = of.derivation.groups.iter().all(|group| group.determinant.is_some());
        let by_hand = has_formulas.then(|| document::of_sheet(signatures.mechanism, signatures.driver, &of.derivation));
        Self { driver, by_hand, scenes }
    }

    /// All of them on one page.
    pub fn page(&self) -> Result<String, Failure> {
        let lender = Lender::default();
        let derivation = self.driver.as_ref().map(|driver| lender.derivation(driver)).transpose()?;
        let scenes = self.scenes.iter().map(|scene| lender.scene(scene)).collect::<Result<Vec<_>, _>>()?;
        let by_hand = self.by_hand.as_ref().map(|sheet| lender.sheet(sheet)).transpose()?;
        let Some(mut sheet) = derivation.as_ref().map(Sheet::new) else { return Ok(String::new()) };
        for scene in &scenes {
            sheet.scene(scene);
        }
        if let Some(by_hand) = &by_hand {
            sheet.by_hand(by_hand);
        }
        Ok(sheet.to_html())
    }

    /// Visits them one after the other.
    pub fn each(&self, mut visit: impl FnMut(&dyn linkage_report::Document)) -> Result<(), Unsound> {
        let lender = Lender::default();
        if let Some(driver) = &self.driver {
            visit(&lender.derivation(driver)?);
        }
        if let Some(sheet) = &self.by_hand {
            visit(&lender.sheet(sheet)?);
        }
        for scene in &self.scenes {
            visit(&lender.scene(scene)?);
        }
        Ok(())
    }
}
