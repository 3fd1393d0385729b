// Parameters on the way down.
#pragma once

namespace loopcheck::core {

/// The child of a face, numbered as in `split`, that holds the parameter (u, v); u and v become its own.
///
/// A corner child doubles them from its corner; the centre child 3 also turns them: u' = 1 - 2u, v' = 1 - 2v.
/// On a common edge the corner children come first.
///
/// Error  none for multiples of twice the roundoff; else 1 - 2u is rounded.
template <class Scalar>
int descend(Scalar& u, Scalar& v) {
    const Scalar half = Scalar(1) / 2;
    const int k = u >= half ? 1 : v >= half ? 2 : u + v <= half ? 0 : 3;
    u = k == 3 ? Scalar(1 - 2 * u) : k == 1 ? Scalar(2 * u - 1) : Scalar(2 * u);
    v = k == 3 ? Scalar(1 - 2 * v) : k == 2 ? Scalar(2 * v - 1) : Scalar(2 * v);
    return k;
}

}  // namespace loopcheck::core
