// Host and kernels read the same structs: every field of them at the same place, at every width.
#include "layout.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../../kernels/path_view.h"
#include "wavefront/isa.h"

using namespace phalanx;

// Weak: null for instruction sets that this build leaves out.
extern "C" __attribute__((weak)) int32 layout_sse4(int32 *values), layout_avx2(int32 *values),
    layout_avx512skx(int32 *values);

namespace {

struct Number {
  std::string name;
  std::size_t value;
};
#define OFFSET_OF(type, field) {#type "::" #field, offsetof(type, field)},
#define SIZE_OF(type) {"sizeof " #type, sizeof(type)},
const std::vector<Number> kHost = {LAYOUT_LIST(OFFSET_OF, SIZE_OF)};

void check_layout(const std::string &isa, int32 (*layout)(int32 *)) {
  if (layout == nullptr || !isa_supported(isa)) return;
  std::vector<int32> values(LAYOUT_MAX);
  REQUIRE(kHost.size() <= values.size());
  REQUIRE(static_cast<std::size_t>(layout(values.data())) == kHost.size());
  for (std::size_t i = 0; i < kHost.size(); ++i) {
    CAPTURE(isa);
    CAPTURE(kHost[i].name);
    CHECK(static_cast<std::size_t>(values[i]) == kHost[i].value);
  }
}

}  // namespace

TEST_CASE("layout: shared structs have the same sizes and offsets in C++ and in ISPC") {
  check_layout("sse4", layout_sse4);
  check_layout("avx2", layout_avx2);
  check_layout("avx512skx", layout_avx512skx);
}

TEST_CASE("layout: no field was forgotten: those of structs without pointers fill them") {
  std::map<std::string, std::size_t> filled, whole;
#define FIELD_SIZE(type, field) filled[#type] += sizeof(std::declval<type &>().field);
#define WHOLE_SIZE(type) whole[#type] = sizeof(type);
  LAYOUT_LIST(FIELD_SIZE, WHOLE_SIZE)
  for (const auto &[type, size] : whole) {
    CAPTURE(type);
    // Pointers bring padding with them, of less than their own size after every run of small fields.
    const bool has_pointers = type.ends_with("View");
    CHECK(filled[type] <= size);
    if (!has_pointers) CHECK(filled[type] == size);
  }
}
