/// How much one more view of the same object counts.
#pragma once

namespace vantage {

/// Exponent on what the view says that comes after `before` others, in (0, 1].
///
/// Views of one object repeat each other: what is odd about the light, the recording or the object
/// itself is odd in all of them, and a filter that takes them for independent given the state is
/// too sure of itself after several. n values with correlation r in pairs are worth as much about
/// what they have in common as n / (1 + (n - 1) r) that are independent, so view n adds
///   w_n = n / (1 + (n - 1) r) - (n - 1) / (1 + (n - 2) r).
/// The first counts whole: psi has been calibrated by single views.
/// @param before at least 0
/// @param correlation r, in [0, 1]; 0: all count whole, 1: but the first none does
double view_weight(int before, double correlation);

}  // namespace vantage
