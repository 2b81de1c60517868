// tests/scene/temporary_folder.h

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace penumbra::scene_test {

// A test that has its own temporary folder, named after the test, because other tests run at the same time.
class TestWithFolder : public testing::Test {
 protected:
  TestWithFolder() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("penumbra_") + test.test_suite_name() + "_" + test.name());
    std::filesystem::create_directory(folder_);
  }
  ~TestWithFolder() override { std::filesystem::remove_all(folder_); }

  // Writes a file in the temporary folder and returns the file's path.
  std::string Write(const std::string& name, std::string_view text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::filesystem::path Path(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

}  // namespace penumbra::scene_test
