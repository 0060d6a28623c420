// SPDX-License-Identifier: BSD-3-Clause
// The sums of a body's normal equations, lane by lane. To be included within Highway's
// foreach_target: once for each instruction set.
#if defined(LOCKBOX_KERNELS_NORMAL_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef LOCKBOX_KERNELS_NORMAL_SUMS_INL
#undef LOCKBOX_KERNELS_NORMAL_SUMS_INL
#else
#define LOCKBOX_KERNELS_NORMAL_SUMS_INL
#endif

#include "field_look_up-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockbox::kernels::HWY_NAMESPACE {

inline double sum_of_lanes(const Float lanes) {
  return static_cast<double>(hn::GetLane(hn::SumOfLanes(FloatTag(), lanes)));
}

/// Hessian and gradient of NormalSums.
struct NormalSumLanes {
  Float hessian[21];
  Float gradient[6];

  HWY_INLINE void set_zero() {
    const FloatTag df;
    for (Float& h : hessian) {
      h = hn::Zero(df);
    }
    for (Float& g : gradient) {
      g = hn::Zero(df);
    }
  }

  /// Points p with field gradient n: weights w, weighted distances wd.
  HWY_INLINE void add(const Float p[3], const Float n[3], const Float w, const Float wd) {
    const Float a[6] = {n[0],
                        n[1],
                        n[2],
                        hn::MulSub(p[1], n[2], hn::Mul(p[2], n[1])),
                        hn::MulSub(p[2], n[0], hn::Mul(p[0], n[2])),
                        hn::MulSub(p[0], n[1], hn::Mul(p[1], n[0]))};
    int k = 0;
    for (int row = 0; row < 6; ++row) {
      const Float wa = hn::Mul(w, a[row]);
      for (int column = row; column < 6; ++column) {
        hessian[k] = hn::MulAdd(wa, a[column], hessian[k]);
        ++k;
      }
      gradient[row] = hn::NegMulAdd(wd, a[row], gradient[row]);
    }
  }

  HWY_INLINE void write(NormalSums& sums) const {
    for (int k = 0; k < 21; ++k) {
      sums.hessian[k] = sum_of_lanes(hessian[k]);
    }
    for (int k = 0; k < 6; ++k) {
      sums.gradient[k] = sum_of_lanes(gradient[k]);
    }
  }
};

/// Mass and moments of NormalSums.
struct MomentLanes {
  Float mass;
  Float first[3];
  Float second[6];

  HWY_INLINE void set_zero() {
    mass = hn::Zero(FloatTag());
    for (Float& f : first) f = mass;
    for (Float& s : second) s = mass;
  }

  /// Points p with weights w.
  HWY_INLINE void add(const Float p[3], const Float w) {
    mass = hn::Add(mass, w);
    int k = 0;
    for (int row = 0; row < 3; ++row) {
      const Float wp = hn::IfThenElseZero(hn::Gt(w, hn::Zero(FloatTag())), hn::Mul(w, p[row]));
      first[row] = hn::Add(first[row], wp);
      for (int column = row; column < 3; ++column) {
        second[k] = hn::MulAdd(wp, p[column], second[k]);
        ++k;
      }
    }
  }

  HWY_INLINE void write(NormalSums& sums) const {
    sums.mass = sum_of_lanes(mass);
    for (int k = 0; k < 3; ++k) sums.first_moment[k] = sum_of_lanes(first[k]);
    for (int k = 0; k < 6; ++k) sums.second_moment[k] = sum_of_lanes(second[k]);
  }
};

}  // namespace lockbox::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
