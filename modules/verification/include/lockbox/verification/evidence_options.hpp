// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lockbox {

/// Quantities of the world that evidence and belief depend on (docs/verification.md): what rooms
/// and built objects are like, whatever the camera and the model.
struct EvidenceOptions {
  /// What a built object differs by from its drawing along the ray. Unit: of the diagonal of the
  /// box around it. Source: an object that is 1 % off its model, halved because it is off to both
  /// sides of its middle. Doubled, parts of a small object that stand out by a sixteenth of it no
  /// longer tell.
  double model_tolerance = 0.005;
  /// The same of a large one, at most. Unit: metres. Source: woodwork. Doubled, parts that stand
  /// out by less than 24 mm no longer tell.
  double most_model_tolerance = 0.004;
  /// The same of a small one, at least. Unit: metres. Source: what the means of 7 x 7 pixels of a
  /// RealSense D4xx err by at half a metre. Doubled, 9 mm are needed for a part of a cup to tell.
  double least_model_tolerance = 0.0015;
  /// The same across the ray. Unit: metres. Source: woodwork and printed parts. Doubled, parts that
  /// stand out by less than 24 mm no longer tell.
  double contour_tolerance = 0.005;
  /// What a contour is off by for the camera's sake, of a 640-column image. Unit: pixels. Source:
  /// its calibration, and what a sensor's window smears. Doubled, handles of two pixels no longer
  /// tell.
  double contour_pixels = 1.0;

  /// What a straight contour that was foretold tells. Unit: nats. Source: where it lies and how it
  /// is turned, each to three cells of 240, and what begins there. Doubled, boxes pass for the
  /// model with half its edges.
  double line = 10.0;
  /// So many along a contour make a line of it. Unit: cells. Source: fewer may be noise. Doubled,
  /// edges of 6 cm at 2 m tell half as much.
  double least_line = 4.0;
  /// Contours of which one foretells the others. Unit: contours. Source: those of a box come in
  /// pairs, and more. Doubled, it takes twice as many to be as sure.
  double alike = 2.5;
  /// The share of contours of the model at which the scene goes on as if there were none. Source:
  /// something in flush contact with it. Doubled, such a line costs 0.7 nats less.
  double flush = 0.02;
  /// The share of a contour's height at which the model bends, too. Source: tolerances of both
  /// sides add to it, or take it away. Doubled, steps of the object that are a little higher than
  /// the model's, but not high enough there, speak against it.
  double faint = 0.5;
  /// The share of contours on the object's faces that its model lacks. Source: not recorded; as
  /// many as are flush. Doubled, such a line costs 0.7 nats less.
  double unmodelled = 0.02;

  /// The share of cells beyond which a surface ends. Source: contours in rooms, of which a cell of
  /// the view sees about one in thirty. Doubled, what is seen through a model costs 0.7 nats less
  /// where there is one.
  double contours = 0.03;
  /// The share of an object's visible cells that are measured wrong, or of which the object lacks
  /// what they show. Source: not recorded. Doubled, a window of cells that is seen through costs
  /// 0.7 nats less.
  double outliers = 0.01;
  /// Cells of a face that are off together, because the face is. Unit: cells. Source: 21 pixels of
  /// 640 across. Doubled, a face that is off by more than twice its tolerance costs half as much.
  double face = 64.0;
  /// What each pair of neighbouring cells costs at which an occluder begins. Unit: nats. Source:
  /// what hides is connected, and as likely large as small. Doubled, an arm costs a visible object
  /// twice as much.
  double occluder_edge = 0.09;

  /// The share of a body's cells that has to be seen for it to tell anything, but for the base's.
  /// Unit: none. Source: of four cells one, or what shows is an edge more than a surface. Doubled,
  /// drawers that are half hidden no longer tell.
  double least_seen = 0.25;

  /// Inverse depths that a sensor measures. Unit: 1 / metre. Source: from 0.35 m on.
  double inverse_range = 2.5;
  /// Within it a cell agrees with what is foretold. Unit: standard deviations. Source: of
  /// normal errors one in 370 is beyond it.
  double agree = 3.0;

  /// Places in a room and ways to be turned that can be told apart, the logarithm of their number.
  /// Unit: nats. Source: 4 m to 2 cm, and turns to 2 degrees: 8 million times 3 million. Doubled in
  /// number, 0.7 nats more.
  double places = 31.0;

  /// What is more than a box can show, of places. Unit: 1. Source: a box, which any room may have,
  /// shows nine edges, the three within on both their sides: 12 lines, 3.9 times as much. Doubled,
  /// cabinets are sought to the end of a round.
  double beyond_a_box = 5.0;

  /// Of what speaks for an answer, the share that may speak against it, unless more is left than a
  /// box can show. Unit: 1. Source: of 88 right answers of tuning scenes (seven models, five of
  /// them not shipped) one has 0.26, all others less than 0.19; a box with a wall on it 0.38, with
  /// 223 nats; a folding chair whose seat was taken for its back 0.33, with 60. Doubled, that is
  /// believed.
  double most_contradicted = 0.3;
};

}  // namespace lockbox
