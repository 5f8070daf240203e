//! A whole sheet, in any format.

use core::fmt;

use super::outline::{Pen, conditions, quantities, solved, words, write_scene};
use super::sheet as by_hand;
use crate::sheet::Sheet;

/// Writes all parts of a sheet but its pictures and properties: equations are numbered through.
pub(super) fn write_whole(sheet: &Sheet<'_>, pen: &mut dyn Pen) -> fmt::Result {
    let derivation = sheet.derivation;
    let mut number = 0;
    pen.title(sheet.title.as_deref().unwrap_or(derivation.mechanism))?;
    sheet.about.iter().try_for_each(|paragraph| pen.lead(paragraph))?;
    pen.heading(words::COORDINATES)?;
    for (role, symbols) in sheet.roles() {
        pen.list(role, &mut symbols.into_iter())?;
    }
    pen.counts(derivation.counts())?;

    match derivation.unknowns {
        [] => {
            pen.heading(words::OPEN_CHAIN)?;
            pen.lead(words::LEAD_OPEN_CHAIN)?;
        }
        _ => solved(derivation, pen, &mut number)?,
    }
    if let Some(by_hand) = sheet.by_hand {
        by_hand::write(by_hand, pen, &mut number)?;
    }

    quantities(pen, &mut number, words::POINTS, derivation.points)?;
    quantities(pen, &mut number, words::OUTPUTS, derivation.outputs)?;
    if !sheet.tables.is_empty() {
        pen.heading(words::NUMBERS)?;
    }
    for table in &sheet.tables {
        pen.table(&table.caption, &table.rows)?;
    }
    if !derivation.kernels.is_empty() {
        pen.heading(words::OPERATIONS)?;
        pen.kernels(derivation.kernels)?;
    }
    conditions(pen, sheet.conditions().into_iter())?;
    for scene in &sheet.scenes {
        write_scene(scene, pen, &mut number)?;
    }
    Ok(())
}
