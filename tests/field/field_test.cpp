// tests/field/field_test.cpp
//
// Files that people have, and files made to break the program: each *.json in this folder is a case, which
// holds what is claimed, where the expected values come from, and what is run (README.md tells the format).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "test_paths.h"
#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kFolder = fs::path(PENUMBRA_SOURCE_DIR) / "tests/field";

// Whether a number is what a case wants; `want` may be a number, "nan", null or nothing.
void ExpectNumber(double got, const json& want, const json& bounds, const std::string& where) {
  SCOPED_TRACE(where);
  if (want.is_string() && want == "nan") {
    EXPECT_TRUE(std::isnan(got)) << got;
    return;
  }
  if (want.is_number()) {
    const double value = want.get<double>();
    const double allowed = std::max(bounds.value("atol", 0.0), bounds.value("rtol", 0.0) * std::abs(value));
    EXPECT_LE(std::abs(got - value), allowed) << "got " << got << ", want " << value;
    EXPECT_FALSE(std::isnan(got));
  }
  if (bounds.contains("at_most")) {
    EXPECT_LE(got, bounds["at_most"].get<double>());
  }
  if (bounds.contains("at_least")) {
    EXPECT_GE(got, bounds["at_least"].get<double>());
  }
}

void ExpectColumns(const std::string& csv, const json& columns) {
  const std::vector<std::string> lines = Lines(csv);
  ASSERT_FALSE(lines.empty());
  const std::vector<std::string> header = Fields(lines[0]);
  for (const auto& [name, bounds] : columns.items()) {
    const auto column = std::find(header.begin(), header.end(), name);
    ASSERT_NE(column, header.end()) << name;
    const auto at = static_cast<std::size_t>(column - header.begin());
    const json want = bounds.value("want", json());
    if (want.is_array()) {
      ASSERT_EQ(lines.size() - 1, want.size()) << name;
    }
    for (std::size_t row = 1; row < lines.size(); ++row) {
      const double got = std::stod(Fields(lines[row]).at(at));
      ExpectNumber(got, want.is_array() ? want[row - 1] : want, bounds,
                   name + " in row " + std::to_string(row));
    }
  }
}

void ExpectNumbers(const std::string& text, const json& numbers) {
  std::istringstream stream(text);
  std::size_t i = 0;
  for (double got = 0; i < numbers["want"].size() && stream >> got; ++i)
    ExpectNumber(got, numbers["want"][i], numbers, "number " + std::to_string(i));
  EXPECT_EQ(i, numbers["want"].size()) << text;
}

void ExpectJson(const fs::path& file, const json& has) {
  std::ifstream stream(file);
  ASSERT_TRUE(stream) << file;
  const json document = json::parse(stream);
  for (const auto& [pointer, want] : has.items()) {
    SCOPED_TRACE(pointer);
    const json::json_pointer at(pointer);
    ASSERT_TRUE(document.contains(at));
    if (want.is_object()) {
      ExpectNumber(document[at].get<double>(), want.value("want", json()), want, pointer);
    } else {
      EXPECT_EQ(document[at], want);
    }
  }
}

void ExpectParts(const std::string& text, const json& run, const std::string& stream) {
  for (const json& part : run.value(stream + "_has", json::array()))
    EXPECT_NE(text.find(part.get<std::string>()), std::string::npos) << part << " is not in:\n" << text;
  for (const json& part : run.value(stream + "_lacks", json::array()))
    EXPECT_EQ(text.find(part.get<std::string>()), std::string::npos) << part << " is in:\n" << text;
}

void Expect(const Outcome& outcome, const Sandbox& sandbox, const json& run, std::vector<std::string> files) {
  EXPECT_EQ(outcome.status, run.value("status", 0)) << outcome.err;
  ExpectParts(outcome.err, run, "err");
  ExpectParts(outcome.out, run, "out");
  if (run.contains("err_lines")) {
    EXPECT_EQ(Lines(outcome.err).size(), run["err_lines"].get<std::size_t>()) << outcome.err;
  }
  if (run.contains("columns")) ExpectColumns(outcome.out, run["columns"]);
  if (run.contains("out_numbers")) ExpectNumbers(outcome.out, run["out_numbers"]);
  if (run.contains("json")) ExpectJson(sandbox.Path(run["json"]["file"]), run["json"]["has"]);
  if (!run.contains("files")) return;
  for (const json& file : run["files"]) files.push_back(file);
  std::sort(files.begin(), files.end());
  EXPECT_EQ(sandbox.Files(), files);
}

void RunCase(const fs::path& path) {
  std::ifstream stream(path);
  const json about = json::parse(stream);
  SCOPED_TRACE(about.at("claim").get<std::string>() + " [" + about.at("source").get<std::string>() + "]");
  const Sandbox sandbox;
  std::vector<std::string> inputs;
  for (const json& input : about.at("inputs")) {
    inputs.push_back(input);
    fs::copy_file(kFolder / inputs.back(), sandbox.Path(inputs.back()));
  }
  for (const json& run : about.at("runs")) {
    const auto arguments = run.at("arguments").get<std::vector<std::string>>();
    SCOPED_TRACE(run.at("arguments").dump());
    Expect(sandbox.Run(arguments), sandbox, run, inputs);
  }
}

class FieldTest : public testing::Test {
 public:
  explicit FieldTest(fs::path path) : path_(std::move(path)) {}
  void TestBody() override { RunCase(path_); }

 private:
  fs::path path_;
};

// The name of a case in CTest: its file's, without the dashes, which filters of tests take for "but not".
std::string NameOf(const fs::path& path) {
  std::string name = path.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

bool RegisterCases() {
  std::vector<fs::path> cases;
  for (const auto& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".json") cases.push_back(entry.path());
  std::sort(cases.begin(), cases.end());
  for (const fs::path& path : cases)
    testing::RegisterTest("Field", NameOf(path).c_str(), nullptr, nullptr, __FILE__, __LINE__,
                          [path]() -> testing::Test* { return new FieldTest(path); });
  return true;
}

const bool kRegistered = RegisterCases();

}  // namespace
}  // namespace penumbra
