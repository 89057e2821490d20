// Files from outside the project, which is not allowed to carry them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

// A machine may be without the folder as a whole; a file that is missing in it fails the test.
#define NEEDS_TEST_DATA()                                  \
  if (!std::filesystem::is_directory(TALUS_TEST_DATA_DIR)) \
  GTEST_SKIP() << "reads files that are no part of the project: set TALUS_TEST_DATA_DIR"
