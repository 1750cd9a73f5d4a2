// Any bytes as a file of points for a SPLINE: as a whole, a block of it, a column of it.
#include <memory>

#include "elements/catalogue.h"
#include "folder.h"
#include "model/model.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace dynalin;
  const fuzz::TimeLimit limit;
  static const fuzz::Folder folder;
  folder.write("points.txt", fuzz::text_of(bytes, count));
  const auto source = std::make_shared<const SourceText>(
      folder.path("model.adm"),
      "points\nSPLINE/1, FILE=points.txt\nSPLINE/2, FILE=points.txt, BLOCK=B\nSPLINE/3, FILE=points.txt, CHANNEL=2\n"
      "VARIABLE/1, FUNCTION=AKISPL(0.1, 0, 1)+CUBSPL(7, 0, 2)+INTERP(0.1, 3, 3)\nEND\n");
  auto parsed = parse_dataset(source);
  fuzz::demand(!parsed.diagnostics.has_errors(), "the dataset around the file is wrong");
  const auto built = build_model(std::make_shared<const Dataset>(std::move(parsed.value)), catalogue());
  fuzz::demand_sound(built.diagnostics);
  return 0;
}
