// pictures.yaml of an import.
#include "vantage/perception/picture_notes.hpp"

#include "tests/fuzz/fuzz_target.hpp"

namespace vantage::fuzz {

void read_input(std::string_view bytes, const InputFolder&) {
  const PictureNotes notes = picture_notes_of(std::string(bytes), "pictures.yaml");
  picture_notes_of(to_text(notes), "pictures.yaml");
}

}  // namespace vantage::fuzz
