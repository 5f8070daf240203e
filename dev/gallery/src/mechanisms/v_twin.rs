use linkage::linkage;

linkage! {
    /// V-twin engine: two slider-cranks side by side on one crank pin, their cylinders at the angle `vee`.
    ///
    /// The angle is that of Harley-Davidson's engines; the lengths are this gallery's.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism VTwin {
        param crank = 50, rod = 180, vee = 45deg;
        input theta;
        unknown phi_front, s_front, phi_rear, s_rear;

        let front = 90deg - vee / 2;
        let rear = 90deg + vee / 2;
        loop crank@theta + rod@phi_front = s_front@front;
        loop crank@theta + rod@phi_rear = s_rear@rear;

        point O = (0, 0);
        point Pin = crank@theta;
        point Front = s_front@front;
        point Rear = s_rear@rear;
        output displaced = s_front + s_rear;
        derive intervals;
    }
}
