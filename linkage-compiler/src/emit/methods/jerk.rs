//! Jerks.

use quote::quote;

use super::{Body, Kernels, Methods, argument_of, check_finite, fenced, lines};
use crate::derivation::Form;
use crate::lower::Stage;

impl Methods<'_> {
    pub(super) fn jerk(&mut self, kernels: Option<&mut Kernels>) {
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let (rate, acceleration) = (self.arguments.rate.clone(), self.arguments.acceleration.clone());
        let jerk = self.arguments.jerk.clone();
        let (inputs, coordinates) = (self.types.inputs.clone(), self.types.coordinates.clone());
        let mut docs = lines([
            "The jerk q''' at the velocity q', the acceleration q'' and the input jerks v''': J u''' = -(A v''' + eta)",
            "with eta = `3 (Psi_q q')_q q'' + ((Psi_q q')_q q')_q q'`.",
        ]);
        let code = kernels.map(|kernels| {
            let eta = kernels.derivation.eta.clone().unwrap_or_default();
            docs.extend(fenced(
                eta.iter().enumerate().map(|(row, &node)| format!("eta_{} = {}", row + 1, kernels.text(node))),
            ));
            let unknowns = kernels.derivation.unknowns.clone();
            let jerks: Vec<_> = kernels.derivation.coordinates.iter().map(|coordinate| coordinate.jerk).collect();
            let targets = unknowns.iter().map(|&index| jerks[index]).collect();
            let side = kernels.derivation.jerk_side();
            let mut stages = kernels.derivation.solution(&[(side, targets)], Form::Factored);
            stages.push(Stage::Return(kernels.variables(&jerks)));
            let sources = vec![
                self.coordinates(kernels, &rate, |c| c.rate),
                self.coordinates(kernels, &acceleration, |c| c.acceleration),
                self.inputs(kernels, &jerk, |c| c.jerk),
            ];
            let mut code = self.on_pose(kernels, sources, &stages);
            let results = code.results.clone();
            let finite = check_finite(&mut code, "jerk", &kernels.checked(&results));
            let fields = self.coordinate_fields();
            let tail = quote!(#finite Ok(#coordinates { #(#fields: #results),* }));
            Body::new(code, tail, [])
        });
        docs.extend(lines(["", "# Errors", "`Singular` where J has no inverse, `NotFinite` if a rate is not finite."]));
        let [pose, rate, acceleration, jerk] =
            [&pose, &rate, &acceleration, &jerk].map(|argument| argument_of(argument, code.as_ref()));
        let signature = quote!(pub fn jerk(&self, #pose: &#pose_type<T>, #rate: &#coordinates<T>, #acceleration: &#coordinates<T>, #jerk: impl Into<#inputs<T>>) -> Result<#coordinates<T>, Error>);
        self.function(&docs, signature, code);
    }
}
