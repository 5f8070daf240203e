//! Motions as curves through dead points of the input.
use super::error::CertifyError;
use super::motion::Motion;
use linkage_runtime::Certifiable;

pub(super) fn dead_point_ahead<M: Certifiable>(_: &Motion<'_, M>, _: f64) -> Option<CertifyError> {
    None
}
