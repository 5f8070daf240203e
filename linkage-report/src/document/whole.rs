//! A whole sheet, in any format.

use core::fmt;

use super::outline::{Pen, conditions, quantities, solved, write_scene};
use super::sheet as by_hand;
use crate::sheet::Sheet;

/// Writes all parts of a sheet but its pictures and properties: equations are numbered through.
pub(super) fn write_whole(sheet: &Sheet<'_>, pen: &mut dyn Pen) -> fmt::Result {
    let (derivation, words) = (&sheet.derivation, sheet.language.words());
    let mut number = 0;
    pen.title(sheet.title.as_deref().unwrap_or(derivation.mechanism))?;
    sheet.about.iter().try_for_each(|paragraph| pen.lead(paragraph))?;
    pen.heading(words.coordinates)?;
    for (role, symbols) in sheet.roles() {
        pen.list(role, &mut symbols.into_iter())?;
    }
    pen.counts(derivation.counts())?;

    match derivation.unknowns {
        [] => {
            pen.heading(words.open_chain)?;
            pen.lead(words.lead_open_chain)?;
        }
        _ => solved(derivation, pen, &mut number)?,
    }
    if let Some(by_hand) = &sheet.by_hand {
        by_hand::write(by_hand, pen, &mut number)?;
    }

    quantities(pen, &mut number, words.points, derivation.points)?;
    quantities(pen, &mut number, words.outputs, derivation.outputs)?;
    if !sheet.tables.is_empty() {
        pen.heading(words.numbers)?;
    }
    for table in &sheet.tables {
        pen.table(table.caption.text(words), &table.rows)?;
    }
    if !derivation.kernels.is_empty() {
        pen.heading(words.operations)?;
        pen.kernels(derivation.kernels)?;
    }
    conditions(pen, sheet.conditions().into_iter())?;
    for scene in &sheet.scenes {
        write_scene(scene, pen, &mut number)?;
    }
    Ok(())
}
