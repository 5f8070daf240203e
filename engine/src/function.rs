//! The table functions `sweep` and `cases`.

use std::sync::Arc;

use datafusion::catalog::{TableFunctionArgs, TableFunctionImpl, TableProvider};
use datafusion::common::ScalarValue;
use datafusion::error::Result;
use datafusion::logical_expr::Expr;

use crate::{EngineError, Mechanisms, SweepTable, TableKind, TableSpec};

/// A table function: the name of a mechanism, and a request in JSON.
#[derive(Debug)]
pub struct SweepFunction {
    pub kind: TableKind,
    pub mechanisms: Arc<Mechanisms>,
}

impl SweepFunction {
    /// Opens the table of a call.
    fn open(&self, arguments: &[Expr]) -> Result<SweepTable, EngineError> {
        let function = self.kind.function();
        let [mechanism, request] = arguments else {
            return Err(EngineError::ArgumentCount { function, count: arguments.len() });
        };
        let mechanism = text(function, 1, "the name of a mechanism", mechanism)?.to_owned();
        let request = text(function, 2, "a plan in JSON", request)?.parse();
        let request = request.map_err(|error: EngineError| error.of(function, &mechanism))?;
        SweepTable::new(&self.mechanisms, TableSpec { kind: self.kind, mechanism, request })
    }
}

impl TableFunctionImpl for SweepFunction {
    fn call_with_args(&self, arguments: TableFunctionArgs<'_, '_>) -> Result<Arc<dyn TableProvider>> {
        Ok(Arc::new(self.open(arguments.exprs())?))
    }
}

/// The text of an argument.
fn text<'a>(
    function: &'static str,
    number: usize,
    meaning: &'static str,
    argument: &'a Expr,
) -> Result<&'a str, EngineError> {
    match argument {
        Expr::Literal(ScalarValue::Utf8(Some(text)) | ScalarValue::Utf8View(Some(text)), _) => Ok(text),
        other => Err(EngineError::Argument { function, number, meaning, got: other.to_string() }),
    }
}
