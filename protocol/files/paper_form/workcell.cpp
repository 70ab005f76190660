// Reads and writes workcell files in plain form (paper, Section III-B); declared in paper_form.hpp.
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/files/paper_form/paper_form.hpp"
#include "protocol/files/paper_form/writer.hpp"

namespace xr3 {
namespace {

using namespace paper;  // NOLINT: keeps the tables below readable

constexpr int kFirstBrightColor = 9;
constexpr int kBrightColors = 6;

const Extras kWorkcellExtras = {{"name", "/name"},
                                {"notes", "/notes"},
                                {"length_unit", "/length_unit"},
                                {"work_surface", "/work_surface"},
                                {"surface_stalls", "/surface_stalls"}};
const Extras kBlockExtras = {{"block", "/name"}, {"color", "/color"}};
const Extras kCameraExtras = {{"projection", "/projection"}};

const DataRow kWorkspaceRow{"workspace: X Y Z", {{"/x"}, {"/y"}, {"/z"}}};
const DataRow kBlockRow{
    "block: length, width, height, x, y, z of its middle, orientation in degrees",
    {{"/size/0"},
     {"/size/1"},
     {"/size/2"},
     {"/centroid/0"},
     {"/centroid/1"},
     {"/centroid/2"},
     {"/yaw_deg"}}};
const std::vector<DataRow> kCameraRows = {
    {"camera location: x y z", {{"/location/0"}, {"/location/1"}, {"/location/2"}}, "/location"},
    {"camera's field of view: length (x), width (y)", {{"/field/0"}, {"/field/1"}}, "/field"},
    {"camera's pixels: columns (x), rows (y)", {{"/pixels/0"}, {"/pixels/1"}}, "/pixels"}};

constexpr const char* kBlocksTitle = "number of blocks";

void read_blocks(PaperReader& reader) {
  const std::size_t blocks = reader.count(kBlocksTitle, "/blocks", kMaxFileBlocks);
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::string block = child_pointer("/blocks", i);
    reader.open(block, kBlockExtras);
    if (reader.row(kBlockRow, block)) {
      reader.set_default(block + "/name", "block " + std::to_string(i + 1));
      reader.set_default(block + "/color", kFirstBrightColor + static_cast<int>(i % kBrightColors));
    }
    reader.close();
  }
}

/// The rest of the file, if any, is the camera.
void read_camera(PaperReader& reader) {
  if (!reader.has_more()) return;
  reader.open("/camera", kCameraExtras);
  for (const DataRow& row : kCameraRows) reader.row(row, "/camera");
  reader.close();
}

void write_blocks(PaperWriter& writer, const Json& blocks) {
  writer.number(kBlocksTitle, blocks.size());
  if (!blocks.empty()) writer.comment(kBlockRow.title);
  for (const Json& block : blocks) {
    writer.extras(kBlockExtras, block);
    writer.line(kBlockRow, block);
  }
}

}  // namespace

FileReading<Workcell> read_paper_workcell(std::string_view text, const std::string& file,
                                          const Robot* robot) {
  PaperReader reader(text, file);
  reader.open("", kWorkcellExtras);
  reader.row(kWorkspaceRow, "/workspace");
  read_blocks(reader);
  read_camera(reader);
  reader.finish();
  reader.set_default("/name", stem_of(file));
  reader.set_default("/length_unit", "mm");
  return reader.merged(read_workcell(reader.json(), file, robot));
}

std::string workcell_to_paper_form(const Workcell& workcell) {
  const Json json = workcell_to_json(workcell);
  PaperWriter writer;
  writer.comment("workcell data file; docs/paper-form.md describes the form");
  writer.extras(kWorkcellExtras, json);
  writer.row(kWorkspaceRow, json["workspace"]);
  write_blocks(writer, json["blocks"]);
  if (json.contains("camera")) {
    writer.extras(kCameraExtras, json["camera"]);
    for (const DataRow& row : kCameraRows) writer.row(row, json["camera"]);
  }
  return writer.take();
}

}  // namespace xr3
