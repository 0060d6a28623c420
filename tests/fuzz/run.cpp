// SPDX-License-Identifier: BSD-3-Clause
// The run.yaml beside a states file. MODEL in it stands for a model that is there, wherever it is.
#include <string>

#include "evaluation_tree.hpp"
#include "fuzz_input.hpp"

namespace {

/// A small box with a coarse field, which is built anew for every input that names it.
std::string model_in(const lockbox::TemporaryFolder& folder) {
  folder.write("box.yaml", "voxel: 0.02\n");
  return folder.write("box.urdf",
                      "<robot name=\"box\"><link name=\"box\"><visual><geometry>"
                      "<box size=\".1 .1 .1\"/></geometry></visual></link></robot>");
}

std::string with_model(std::string text, const std::string& model) {
  constexpr std::string_view kName = "MODEL";
  const auto at = text.find(kName);
  return at == std::string::npos ? text : text.replace(at, kName.size(), model);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockbox;
  static const TemporaryFolder folder;
  static const std::string model = model_in(folder);
  static const auto states = folder.write("states.csv", "");
  folder.write("run.yaml", with_model(as_text(data, size), model));
  LoadOptions options;
  options.cache_directory = "";
  take_or_refuse(folder, [&] { app::model_of_run(states, options); });
  return 0;
}
