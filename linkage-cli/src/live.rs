//! Sheets whose numbers and picture follow sliders: a sheet with a module that runs the compiled mechanism, and its data.

use std::collections::BTreeMap;
use std::io::Write;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use serde_json::json;

use crate::arguments;
use crate::failure::Failure;
use crate::machine::Machine;
use crate::motion::held;
use crate::page::{file, replaced};
use crate::source::read;

/// The place of the data in the built page.
const DATA: &str = "LINKAGE_DATA";

/// A sheet as a page, with the module and the data that it runs.
pub fn live(sheet: &str, arguments: &arguments::Sheet) -> Result<String, Failure> {
    let part = |name: &str| file(arguments.page.as_deref(), name);
    let (head, body) = (part("live-head.html")?, part("live-body.html")?);
    let body = replaced(&body, DATA, &data(arguments)?)?;
    let sheet = replaced(sheet, "<meta charset=\"utf-8\">", &format!("<meta charset=\"utf-8\">\n{head}"))?;
    replaced(&sheet, "</body>", &format!("{body}</body>"))
}

/// The compiled mechanisms, and the position with which the sheet begins, as JSON that is deflated and written in base64: a tenth of
/// the bytes, and no text in it can end its element.
fn data(arguments: &arguments::Sheet) -> Result<String, Failure> {
    let (machine, ()) = Machine::with(&arguments.numbers, |_| ())?;
    let inputs = held(&machine, &arguments.place.at, None)?;
    let unknowns = machine.place(&inputs, &vec![0.0; inputs.len()]).map_err(Failure::Outside)?;
    let text = read(&arguments.numbers.source.file)?.text;
    let data = json!({
        "written": linkage_page::compiled(&text).map_err(|refusal| Failure::Outside(refusal.why))?,
        "name": machine.about.name,
        "parameters": machine.parameters().iter().cloned().collect::<BTreeMap<String, f64>>(),
        "place": { "inputs": inputs, "unknowns": unknowns },
        "rate": arguments.rate.map(|rate| rate.number),
    });
    let mut deflated = DeflateEncoder::new(Vec::new(), Compression::best());
    let written = deflated.write_all(data.to_string().as_bytes()).and_then(|()| deflated.finish());
    Ok(BASE64_STANDARD.encode(written.map_err(|error| Failure::Outside(error.to_string()))?))
}
