#pragma once

// What is compiled once per instruction set (dynamics/wide/), behind pointers.

#include "dynamics/wide_joints.h"
#include "dynamics/wide_rows.h"

#include <span>

namespace carom::internal {

/// The passes over wide rows and joints, compiled for one instruction set. Every set does the same, bit for bit.
struct WideKernels
{
    const char* name;
    /// Effective masses, once all lanes are filled.
    void (*prepare)(WideRow* rows, std::int32_t count);
    void (*warm_start)(WideRow* rows, std::int32_t count, BodyState* states);
    /// One pass of sequential impulses; with bias the soft constraint also removes overlap, without it only stops approach and sums impulses.
    void (*solve)(WideRow* rows, std::int32_t count, BodyState* states, const WideSoftness& s);
    /// Also notes of each group which lanes have been struck, or have begun to touch and this is not yet told.
    void (*relax)(WideRow* rows, std::int32_t count, BodyState* states, const WideSoftness& s, std::uint8_t* struck);
    /// Approach speeds of groups that may be struck.
    void (*note_approach)(WideRow* rows, std::int32_t count, const BodyState* states);
    /// Once all lanes are filled.
    void (*prepare_joints)(WideJoint* joints, std::int32_t count);
    void (*warm_start_joints)(WideJoint* joints, std::int32_t count, BodyState* states);
    void (*solve_joints)(WideJoint* joints, std::int32_t count, BodyState* states, const JointSoftness& s);
    /// At the poses that the bodies have come to; the other passes are at those that relaxing last found.
    void (*relax_joints)(WideJoint* joints, std::int32_t count, BodyState* states, const JointSoftness& s);
};

/// The best that this machine has, or that CAROM_ISA allows (sse2, avx2, avx512); chosen once.
[[nodiscard]] const WideKernels& wide_kernels();

/// All that this machine can run, the best last.
[[nodiscard]] std::span<const WideKernels* const> all_wide_kernels();

/// For tests, while no scene steps.
void use_wide_kernels(const WideKernels& kernels);

} // namespace carom::internal
