// SPDX-License-Identifier: BSD-3-Clause
// Makes the errors of some tens of values independent, and sums up what these tell.
//
// Written once with Highway, compiled for every instruction set, chosen at run time.
#pragma once

#include "lockbox/kernels/padded_rows.hpp"

namespace lockbox::kernels {

/// values <- F^-1 values, of as many rows as the covariance C = F F' of their errors has.
/// covariance: its upper triangle is read, and overwritten; positive definite.
void whiten(PaddedRows& covariance, PaddedRows& values);

/// products <- values' values, of the first so many rows. products is resized.
void multiply_columns(std::size_t rows, PaddedRows& values, PaddedRows& products);

}  // namespace lockbox::kernels
