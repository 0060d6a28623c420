// SPDX-License-Identifier: BSD-3-Clause
// The quantities of the world that evidence depends on. Each says where it comes from, and what
// happens when it is doubled (docs/verification.md).
#pragma once

namespace lockbox::evidence {

/// The width of the view that is looked at. Unit: columns. Source: of a 640-column image a cell is
/// then 2.7 pixels, as wide as the errors of neighbouring pixels are alike
/// (SensorNoise::correlation_pixels), so that cells err by themselves. Doubled, cells no longer err
/// by themselves, and noise makes contours.
inline constexpr int kColumns = 240;

/// What a built object differs by from its drawing along the ray. Unit: of the diagonal of the box
/// around it. Source: an object that is 1 % off its model, halved because it is off to both sides
/// of its middle. Doubled, parts of a small object that stand out by a sixteenth of it no longer
/// tell.
inline constexpr double kModelTolerance = 0.005;
/// The same of a large one, at most. Unit: metres. Source: woodwork. Doubled, parts that stand out
/// by less than 24 mm no longer tell.
inline constexpr double kMostModelTolerance = 0.004;
/// The same of a small one, at least. Unit: metres. Source: what the means of 7 x 7 pixels of a
/// RealSense D4xx err by at half a metre. Doubled, 9 mm are needed for a part of a cup to tell.
inline constexpr double kLeastModelTolerance = 0.0015;
/// The same across the ray. Unit: metres. Source: woodwork and printed parts. Doubled, parts that
/// stand out by less than 24 mm no longer tell.
inline constexpr double kContourTolerance = 0.005;
/// What a contour is off by for the camera's sake, of a 640-column image. Unit: pixels. Source:
/// its calibration, and what a sensor's window smears. Doubled, handles of two pixels no longer
/// tell.
inline constexpr double kContourPixels = 1.0;

/// What a straight contour that was foretold tells. Unit: nats. Source: where it lies and how it is
/// turned, each to three cells of 240, and what begins there. Doubled, boxes pass for the model
/// with half its edges.
inline constexpr double kLine = 10.0;
/// So many along a contour make a line of it. Unit: cells. Source: fewer may be noise. Doubled,
/// edges of 6 cm at 2 m tell half as much.
inline constexpr double kLeastLine = 4.0;
/// Contours of which one foretells the others. Unit: contours. Source: those of a box come in
/// pairs, and more. Doubled, it takes twice as many to be as sure.
inline constexpr double kAlike = 2.5;
/// The share of contours of the model at which the scene goes on as if there were none. Source:
/// something in flush contact with it. Doubled, such a line costs 0.7 nats less.
inline constexpr double kFlush = 0.02;
/// The share of a contour's height at which the model bends, too. Source: tolerances of both sides
/// add to it, or take it away. Doubled, steps of the object that are a little higher than the
/// model's, but not high enough there, speak against it.
inline constexpr double kFaint = 0.5;
/// The share of contours on the object's faces that its model lacks. Source: not recorded; as
/// many as are flush. Doubled, such a line costs 0.7 nats less.
inline constexpr double kUnmodelled = 0.02;

/// The share of cells beyond which a surface ends. Source: contours in rooms, of which a cell of
/// the view sees about one in thirty. Doubled, what is seen through a model costs 0.7 nats less
/// where there is one.
inline constexpr double kContours = 0.03;
/// The share of an object's visible cells that are measured wrong, or of which the object lacks
/// what they show. Source: not recorded. Doubled, a window of cells that is seen through costs 0.7
/// nats less.
inline constexpr double kOutliers = 0.01;
/// Cells of an image in which a sensor errs alike. Unit: cells. Source: the square of the window
/// that it compares, 11 pixels of 640 across. Doubled, what is seen through the model costs half as
/// much.
inline constexpr double kWindow = 16.0;
/// Cells of a face that are off together, because the face is. Unit: cells. Source: 21 pixels of
/// 640 across. Doubled, a face that is off by more than twice its tolerance costs half as much.
inline constexpr double kFace = 64.0;
/// What each pair of neighbouring cells costs at which an occluder begins. Unit: nats. Source: what
/// hides is connected, and as likely large as small. Doubled, an arm costs a visible object twice
/// as much.
inline constexpr double kOccluderEdge = 0.09;

/// The share of a body's cells that has to be seen for it to tell anything, but for the base's.
/// Unit: none. Source: of four cells one, or what shows is an edge more than a surface. Doubled,
/// drawers that are half hidden no longer tell.
inline constexpr double kLeastSeen = 0.25;

/// Inverse depths that a sensor measures. Unit: 1 / metre. Source: from 0.35 m on.
inline constexpr double kInverseRange = 2.5;
/// Within it a cell agrees with what is foretold. Unit: standard deviations. Source: of
/// normal errors one in 370 is beyond it.
inline constexpr double kAgree = 3.0;

/// Places in a room and ways to be turned that can be told apart, the logarithm of their number.
/// Unit: nats. Source: 4 m to 2 cm, and turns to 2 degrees: 8 million times 3 million. Doubled in
/// number, 0.7 nats more.
inline constexpr double kPlaces = 31.0;

/// What is more than a box can show, of kPlaces. Unit: 1. Source: a box, which any room may have,
/// shows nine edges, the three within on both their sides: 12 lines, 3.9 times as much. Doubled,
/// cabinets are sought to the end of a round.
inline constexpr double kBeyondABox = 5.0;

}  // namespace lockbox::evidence
