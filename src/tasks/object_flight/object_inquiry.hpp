/// What the robot wants to know of the object on the table: what it is, or whether it is still what
/// and how its map says.
#pragma once

#include <string>
#include <variant>

#include "vantage/perception/object_segmentation.hpp"
#include "vantage/recognition/change_detection.hpp"

namespace vantage {

/// From what was cut out of an image, which must outlive the result; of none the reason why.
ExtractFeature extract_from(const Recogniser& recogniser, const SegmentedObject& seen);

class ObjectInquiry {
 public:
  /// What is it? @param recogniser outlives this
  ObjectInquiry(const Recogniser& recogniser, const RecognitionOptions& options);
  /// Is it still what is expected?
  /// @param recogniser knows the object; outlives this
  /// @param seen_yaw_rad of the object expected, from where the camera is at first
  ObjectInquiry(const Recogniser& recogniser, const ChangeOptions& options,
                const std::string& object, double seen_yaw_rad);

  /// Takes in a view. @param view_time_s that it took to choose it
  void observe(const ExtractFeature& extract, double view_rad, double view_time_s, Rng& rng);
  /// The camera turned about the object by that, counter-clockwise seen from above.
  void turned(double motion_rad);
  /// Why it looks no further: it knows, or has looked often enough; empty: it does.
  [[nodiscard]] std::string over() const;

  [[nodiscard]] const Recognition& recognition() const;
  [[nodiscard]] bool of_change() const { return std::holds_alternative<ChangeSearch>(known_); }
  /// Only of_change(); an object that is held to be taken away is a change, which views of nothing
  /// cannot weigh.
  [[nodiscard]] double p_changed() const;
  [[nodiscard]] Change verdict() const;  ///< likewise

 private:
  const Recogniser& recogniser_;
  ChangeOptions options_;  ///< `recognition` serves both
  std::variant<Recognition, ChangeSearch> known_;
};

}  // namespace vantage
