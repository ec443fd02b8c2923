// One program for all tests; ctest runs it once per folder, by source file.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
