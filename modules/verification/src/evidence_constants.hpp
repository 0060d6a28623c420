// SPDX-License-Identifier: BSD-3-Clause
// The cells in which evidence is looked for: what the code is laid out for. All else that it
// depends on is in EvidenceOptions.
#pragma once

namespace lockbox::evidence {

/// The width of the view that is looked at. Unit: columns. Source: of a 640-column image a cell is
/// then three pixels, as wide as the errors of neighbouring pixels are alike
/// (SensorNoise::correlation_pixels), so that cells err by themselves. Doubled, cells no longer err
/// by themselves, and noise makes contours.
inline constexpr int kColumns = 240;
/// A narrower width, by which answers are compared closely, too (Verifier::compare()). Unit:
/// columns. Source: two pixels of 640 instead of three. Doubled, cells are pixels, which err alike
/// with every sensor.
inline constexpr int kNarrowColumns = 320;
/// A wider one, likewise. Unit: columns. Source: four pixels of 640. Halved, handles of two pixels
/// tell nothing.
inline constexpr int kWideColumns = 160;
/// Cells of an image in which a sensor errs alike. Unit: cells. Source: the square of the window
/// that it compares, 11 pixels of 640 across. Doubled, what is seen through the model costs half as
/// much.
inline constexpr double kWindow = 16.0;

}  // namespace lockbox::evidence
