//! gamma and accelerations.

use quote::quote;

use super::{Body, Kernels, Methods, argument_of, check_finite, fenced, lines, without_result};
use crate::derivation::Form;
use crate::lower::Stage;

impl Methods<'_> {
    pub(super) fn acceleration(&mut self, kernels: Option<&mut Kernels>) {
        let (u, v) = (self.driver.unknowns.len(), self.driver.inputs.len());
        let (pose, pose_type) = (self.arguments.pose.clone(), self.types.pose.clone());
        let (rate, acceleration) = (self.arguments.rate.clone(), self.arguments.acceleration.clone());
        let (inputs, coordinates) = (self.types.inputs.clone(), self.types.coordinates.clone());
        let mut docs = vec!["The quadratic velocity term gamma = `(Psi_q q')_q q'`.".to_owned()];
        let mut gamma = None;
        let mut code = None;
        if let Some(kernels) = kernels {
            let nodes = kernels.derivation.gamma.clone();
            docs.extend(fenced(
                nodes.iter().enumerate().map(|(row, &node)| format!("gamma_{} = {}", row + 1, kernels.text(node))),
            ));
            let rates = self.coordinates(kernels, &rate, |c| c.rate);
            let written = self.on_pose(kernels, vec![rates], &[Stage::Return(nodes)]);
            let results = &written.results;
            let tail = quote!(SVector::from([#(#results),*]));
            gamma = Some(Body::new(written, tail, []));

            let (unknowns, all) = (kernels.derivation.unknowns.clone(), (0..u + v).collect::<Vec<_>>());
            let side = kernels.derivation.acceleration_side();
            let mut stages = kernels.derivation.solution(&[(side, kernels.accelerations(&unknowns))], Form::Entries);
            stages.push(Stage::Return(kernels.variables(&kernels.accelerations(&all))));
            let rates = self.coordinates(kernels, &rate, |c| c.rate);
            let sources = vec![rates, self.inputs(kernels, &acceleration, |c| c.acceleration)];
            let mut written = self.on_pose(kernels, sources, &stages);
            let results = written.results.clone();
            let finite = check_finite(&mut written, "acceleration", &kernels.checked(&results));
            let fields = self.coordinate_fields();
            let tail = quote!(#finite Ok(#coordinates { #(#fields: #results),* }));
            code = Some(Body::new(written, tail, []));
        }
        let [own, own_rate] = [&pose, &rate].map(|argument| argument_of(argument, gamma.as_ref()));
        let signature = self.words.total(
            "gamma",
            [self.words.borrowed(&own, &pose_type), self.words.borrowed(&own_rate, &coordinates)],
            self.words.sized("SVector", [u]),
        );
        self.function(&without_result(docs), signature, gamma);
        let docs = lines([
            "The acceleration q'' at the velocity q' and the input accelerations v'': J u'' = -(A v'' + gamma).",
            "",
            "# Errors",
            "`Singular` where J has no inverse, `NotFinite` if a rate is not finite.",
        ]);
        let [pose, rate, acceleration] =
            [&pose, &rate, &acceleration].map(|argument| argument_of(argument, code.as_ref()));
        let signature = self.words.fallible(
            "acceleration",
            [
                self.words.borrowed(&pose, &pose_type),
                self.words.borrowed(&rate, &coordinates),
                self.words.converted(&acceleration, &inputs),
            ],
            self.words.of(&coordinates),
        );
        self.function(&docs, signature, code);
    }
}
