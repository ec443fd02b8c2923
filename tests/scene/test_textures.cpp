// Textures from the scene file to what kernels read: image files, good and bad, and data of meshes.
#include <doctest/doctest.h>
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "../../kernels/physics/texture.h"
#include "core/srgb.h"
#include "output/exr.h"
#include "output/hdr.h"
#include "output/temp_dir.h"
#include "scene/build.h"
#include "scene_texts.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

const MaterialDescription &named(const SceneDescription &scene, const std::string &name) {
  const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                  [&](const MaterialDescription &m) { return m.name == name; });
  REQUIRE(found != scene.materials.end());
  return *found;
}

/// A scene of some textures and a material that uses the first, in a folder.
std::string scene_text(const std::string &textures) {
  return R"({"version": 1, "textures": [)" + textures +
         R"(], "materials": [{"name": "m", "type": "diffuse", "reflectance": "t"}]})";
}

std::string image_texture(const std::string &file, const std::string &more = "") {
  return R"({"name": "t", "type": "image", "file": ")" + file + "\"" + more + "}";
}

struct Built {
  SceneDescription description;
  Scene scene;
  std::string errors;
};

Built build(const std::string &text, const std::string &folder) {
  Built built;
  Diagnostics diagnostics;
  built.description = parse_scene_text(text, "scene.json", folder, diagnostics);
  if (!diagnostics.has_errors()) built.scene = build_scene(built.description, diagnostics);
  built.errors = errors_of(diagnostics);
  return built;
}

Scene build_good(const std::string &text, const std::string &folder) {
  Built built = build(text, folder);
  REQUIRE(built.errors == "");
  return std::move(built.scene);
}

void append(void *context, void *data, int size) {
  static_cast<std::string *>(context)->append(static_cast<const char *>(data),
                                              static_cast<std::size_t>(size));
}

std::string png(int width, int height, int channels, const std::vector<unsigned char> &pixels) {
  std::string bytes;
  REQUIRE(stbi_write_png_to_func(append, &bytes, width, height, channels, pixels.data(),
                                 width * channels) != 0);
  return bytes;
}

std::string jpeg(int width, int height) {
  std::vector<unsigned char> pixels;
  for (int i = 0; i < width * height; i++)
    for (const int c : {200, 100, 50}) pixels.push_back(static_cast<unsigned char>(c + i % 7));
  std::string bytes;
  REQUIRE(stbi_write_jpg_to_func(append, &bytes, width, height, 3, pixels.data(), 95) != 0);
  return bytes;
}

Image float_image(int width, int height) {
  Image image = make_image(width, height);
  for (const char *channel : {"R", "G", "B"}) {
    std::vector<float> &plane = add_channel(image, channel);
    for (std::size_t i = 0; i < plane.size(); i++)
      plane[i] = std::ldexp(1.0f, static_cast<int>(i % 5)) * (channel[0] == 'R' ? 1.0f : 0.5f);
  }
  return image;
}

uint32 rgba(uint32 r, uint32 g, uint32 b, uint32 a) { return r | g << 8 | b << 16 | a << 24; }

/// What is said about a file of some bytes.
std::string errors_of_file(const TempDir &folder, const std::string &name,
                           const std::string &bytes) {
  put(folder / name, bytes);
  return build(scene_text(image_texture(name)), folder.path()).errors;
}

void put_number(std::string &bytes, std::size_t at, std::uint32_t number, int size) {
  for (int i = 0; i < size; i++)
    bytes[at + static_cast<std::size_t>(i)] = static_cast<char>(number >> (8 * (size - 1 - i)));
}

}  // namespace

TEST_CASE("textures: every key says what it says") {
  Diagnostics diagnostics;
  const SceneDescription scene =
      load_scene_file(source_path("tests/scene/valid/everything.json"), diagnostics);
  REQUIRE(errors_of(diagnostics) == "");
  REQUIRE(scene.textures.size() == 8);
  const TextureDescription &grey = scene.textures[0], &tiles = scene.textures[1],
                           &floor = scene.textures[3], &cubes = scene.textures[4],
                           &veins = scene.textures[5], &clouds = scene.textures[6],
                           &painted = scene.textures[7];
  CHECK(grey.kind == kConstantTexture);
  CHECK(grey.a == Double3{0.25, 0.5, 0.75});
  CHECK(tiles.kind == kImageTexture);
  CHECK(tiles.file.ends_with("tests/scene/valid/tiles.png"));
  CHECK(tiles.file_place.json_path == "/textures/1/file");
  CHECK(!tiles.srgb);
  CHECK(tiles.a == Double3{0.5, 1, 2});
  CHECK(tiles.channel == 3);
  CHECK(tiles.wrap_u == kClamp);
  CHECK(tiles.wrap_v == kMirrored);
  CHECK(tiles.nearest);
  const double expected[2][3] = {{0, -3, 0.25}, {2, 0, 0.5}};  // scaled, turned, moved
  for (int row = 0; row < 2; row++)
    for (int column = 0; column < 3; column++)
      CHECK(tiles.to_texture[row][column] == expected[row][column]);
  CHECK(floor.kind == kCheckerTexture);
  CHECK(floor.a == Double3{0.5, 0.25, 0.125});
  CHECK(floor.b == Double3{0.75, 0.75, 0.75});
  CHECK(floor.to_texture[1][1] == 8);
  CHECK(floor.scale == 0);
  CHECK(cubes.scale == 2.5);
  CHECK(veins.kind == kMarbleTexture);
  CHECK(veins.turbulence == 2);
  CHECK(veins.octaves == 4);
  CHECK(clouds.kind == kNoiseTexture);
  CHECK(clouds.scale == 0.5);
  CHECK(painted.kind == kVertexColourTexture);
  CHECK(painted.channel == 1);

  const MaterialDescription &wall = named(scene, "wall"), &screen = named(scene, "screen");
  CHECK(wall.textures.reflectance == 1);
  CHECK(wall.textures.normal == 1);
  CHECK(wall.textures.bump == 2);
  CHECK(wall.normal_scale == 0.5);
  CHECK(wall.bump_scale == 0.02);
  CHECK(wall.opacity == 0.75);
  CHECK(wall.textures.opacity == -1);
  CHECK(screen.textures.emission == 7);
  CHECK(screen.emission == Double3{5, 6, 7});
  CHECK(screen.textures.opacity == 1);
  CHECK(named(scene, "worn").textures.roughness == 6);
  CHECK(named(scene, "stained").textures.specular == 3);
  CHECK(named(scene, "stained").textures.transmittance == 5);
  CHECK(named(scene, "red").textures.reflectance == -1);
}

TEST_CASE("textures: materials and textures are built as described") {
  const std::string folder = source_path("tests/scene/valid");
  const Scene scene = build_good(R"({"version": 1,
    "textures": [
      {"name": "t", "type": "image", "file": "tiles.png", "colour_space": "linear", "tint": 0.5,
       "channel": "g", "wrap": "clamp", "filter": "nearest", "transform": {"scale": [2, 4], "offset": [1, 3]}},
      {"name": "n", "type": "marble", "a": 0.25, "b": [0.5, 0, 1], "scale": 3, "turbulence": 2, "octaves": 5}],
    "materials": [
      {"name": "plain", "type": "diffuse"},
      {"name": "holes", "type": "diffuse", "opacity": "t", "normal_map": "t", "bump_map": "n", "bump_scale": 2},
      {"name": "metal", "type": "conductor", "roughness": "n"},
      {"name": "screen", "type": "black", "emission": "t", "emission_scale": 7}]})",
                                 folder);
  const Texture &t = scene.textures[0], &n = scene.textures[1];
  CHECK((t.kind == kImageTexture && t.format == kByteTexels && t.first == 0));
  CHECK((t.width == 4 && t.height == 2 && t.srgb == 0 && t.nearest == 1 && t.channel == 1));
  CHECK((t.wrap_u == kClamp && t.wrap_v == kClamp));
  CHECK((t.m00 == 2 && t.m01 == 0 && t.m02 == 1 && t.m10 == 0 && t.m11 == 4 && t.m12 == 3));
  CHECK(t.a.x == 0.5f);
  CHECK((n.kind == kMarbleTexture && n.scale == 3 && n.turbulence == 2 && n.octaves == 5));
  CHECK((n.a.y == 0.25f && n.b.z == 1));
  const Material &plain = scene.materials[0], &holes = scene.materials[1],
                 &metal = scene.materials[2], &screen = scene.materials[3];
  CHECK((plain.textured == 0 && plain.opacity == 1 && plain.reflectance_texture == -1));
  CHECK((holes.textured == 0 && holes.opacity_texture == 0 && holes.normal_texture == 0));
  CHECK((holes.bump_texture == 1 && holes.bump_scale == 2 && holes.opacity == 1));
  CHECK((metal.textured == 1 && metal.roughness_texture == 1 && metal.alpha >= 1e-3f));
  CHECK((screen.textured == 0 && screen.emission_texture == 0 && screen.emission.x == 7));
  const SceneView view = scene.view();
  CHECK(view.num_textures == 2);
  CHECK(view.decode[255] == 1.0f);
  CHECK(view.byte_texels[0] == rgba(255, 0, 0, 255));
  CHECK(view.byte_texels[4] == rgba(188, 188, 188, 128));
}

TEST_CASE("textures: a scene without them holds nothing of them") {
  const Scene scene = build_good(R"({"version": 1, "materials": [{"name": "m", "type": "diffuse"}],
    "shapes": [{"type": "mesh", "material": "m", "positions": [0, 0, 0, 1, 0, 0, 0, 1, 0], "indices": [0, 1, 2],
                "uvs": [0, 0, 1, 0, 0, 1], "colours": [1, 0, 0, 0, 1, 0, 0, 0, 1]}]})",
                                 ".");
  CHECK(scene.textures.empty());
  CHECK(scene.decode.empty());
  CHECK(scene.byte_texels.empty());
  CHECK(scene.float_texels.empty());
  CHECK(scene.vertex_uvs.empty());
  CHECK(scene.vertex_colours.empty());
  CHECK(scene.geometries[0].has_uvs == 0);
  CHECK(scene.geometries[0].has_colours == 0);
}

TEST_CASE("textures: PNG of every kind and JPEG become the texels that they hold") {
  const TempDir folder;
  put(folder / "grey.png", png(2, 1, 1, {10, 200}));
  put(folder / "grey-alpha.png", png(1, 1, 2, {10, 20}));
  put(folder / "rgb.PNG", png(1, 2, 3, {1, 2, 3, 4, 5, 6}));
  put(folder / "rgba.png", png(1, 1, 4, {1, 2, 3, 4}));
  put(folder / "photo.jpg", jpeg(37, 23));
  const auto read = [&](const std::string &file, const std::string &more = "") {
    return build_good(scene_text(image_texture(file, more)), folder.path());
  };
  CHECK(read("grey.png").byte_texels ==
        std::vector<uint32>{rgba(10, 10, 10, 255), rgba(200, 200, 200, 255)});
  CHECK(read("grey-alpha.png").byte_texels == std::vector<uint32>{rgba(10, 10, 10, 20)});
  CHECK(read("rgb.PNG").byte_texels == std::vector<uint32>{rgba(1, 2, 3, 255), rgba(4, 5, 6, 255)});
  CHECK(read("rgba.png").byte_texels == std::vector<uint32>{rgba(1, 2, 3, 4)});
  CHECK(read("rgba.png").textures[0].srgb == 1);
  CHECK(read("rgba.png", R"(, "colour_space": "linear")").textures[0].srgb == 0);
  const Scene photo = read("photo.jpg");
  CHECK((photo.textures[0].width == 37 && photo.textures[0].height == 23));
  REQUIRE(photo.byte_texels.size() == 37 * 23);
  for (const uint32 texel : photo.byte_texels) {
    CHECK(std::abs(static_cast<int>(texel & 255) - 203) < 16);
    CHECK(std::abs(static_cast<int>((texel >> 8) & 255) - 103) < 16);
    CHECK((texel >> 24) == 255);
  }
}

TEST_CASE("textures: 16-bit PNG, HDR and EXR become floats") {
  const std::string valid = source_path("tests/scene/valid");
  for (const bool srgb : {true, false}) {
    const Scene relief = build_good(
        scene_text(image_texture("relief.png", srgb ? "" : R"(, "colour_space": "linear")")),
        valid);
    REQUIRE(relief.float_texels.size() == 4 * 6);
    const auto expected = [&](double value) {
      return static_cast<float>(srgb ? linear_from_srgb(value / 65535) : value / 65535);
    };
    CHECK(relief.float_texels[4] == expected(0x1234));
    CHECK(relief.float_texels[4 * 3 + 2] == expected(0x8000));
    CHECK(relief.float_texels[4 * 4] == expected(1));
    CHECK(relief.float_texels[4 * 4 + 3] == 1.0f);
  }
  const TempDir folder;
  Image image = float_image(5, 3);
  put(folder / "sky.hdr", encode_hdr(image));
  add_channel(image, "A").assign(15, 0.25f);
  image.channels[0].values[7] = -3;  // heights may be negative
  put(folder / "sky.exr", encode_exr(image));
  Image lone = make_image(2, 1);
  add_channel(lone, "Y") = {0.5f, 2};
  put(folder / "lone.exr", encode_exr(lone));
  const Scene hdr = build_good(scene_text(image_texture("sky.hdr")), folder.path());
  const Scene exr = build_good(scene_text(image_texture("sky.exr")), folder.path());
  const Scene grey = build_good(scene_text(image_texture("lone.exr")), folder.path());
  CHECK((hdr.textures[0].format == kFloatTexels && hdr.textures[0].width == 5));
  for (std::size_t i = 0; i < 15; i++)
    for (std::size_t c = 0; c < 3; c++) {
      CHECK(exr.float_texels[4 * i + c] == image.channels[c].values[i]);
      if (image.channels[c].values[i] > 0)
        CHECK(hdr.float_texels[4 * i + c] == image.channels[c].values[i]);
      CHECK(exr.float_texels[4 * i + 3] == 0.25f);
      CHECK(hdr.float_texels[4 * i + 3] == 1.0f);
    }
  CHECK(grey.float_texels == std::vector<float>{0.5f, 0.5f, 0.5f, 1, 2, 2, 2, 1});
}

TEST_CASE("textures: an image that several textures show is read once") {
  const std::string tiles = R"("type": "image", "file": "tiles.png")";
  const Scene scene =
      build_good(scene_text(R"({"name": "t", )" + tiles + R"(}, {"name": "u", "wrap": "clamp", )" +
                            tiles + R"(}, {"name": "v", "type": "image", "file": "relief.png"})"),
                 source_path("tests/scene/valid"));
  CHECK(scene.byte_texels.size() == 8);
  CHECK(scene.float_texels.size() == 24);
  CHECK(scene.textures[1].first == scene.textures[0].first);
  CHECK(scene.textures[1].width == 4);
  CHECK(scene.textures[1].wrap_u == kClamp);
  CHECK(scene.textures[2].first == 0);
}

TEST_CASE("textures: a file that was cut anywhere is an error that names file and texture") {
  const TempDir folder;
  std::vector<unsigned char> pixels;
  for (int i = 0; i < 40 * 30 * 3; i++) pixels.push_back(static_cast<unsigned char>(i * i / 7));
  const Image image = float_image(40, 30);
  const std::pair<const char *, std::string> files[] = {{"cut.png", png(40, 30, 3, pixels)},
                                                        {"cut.jpg", jpeg(40, 30)},
                                                        {"cut.hdr", encode_hdr(image)},
                                                        {"cut.exr", encode_exr(image)}};
  for (const auto &[name, bytes] : files) {
    CAPTURE(std::string(name));
    REQUIRE(errors_of_file(folder, name, bytes) == "");
    const std::size_t step = std::max<std::size_t>(1, bytes.size() / 150);
    for (std::size_t size = 0; size < bytes.size(); size += step) {
      CAPTURE(size);
      const std::string errors = errors_of_file(folder, name, bytes.substr(0, size));
      CHECK(errors.starts_with("scene.json:1:"));
      CHECK(errors.find("/textures/0/file: ") != std::string::npos);
      CHECK(errors.find(folder / name) != std::string::npos);
      CHECK(std::count(errors.begin(), errors.end(), '\n') == 1);
    }
  }
}

TEST_CASE("textures: damaged files are errors or pictures, but no crash") {
  const TempDir folder;
  unsigned state = 1;
  for (const auto &[name, bytes] : {std::pair<std::string, std::string>{"a.jpg", jpeg(33, 17)},
                                    {"a.png", png(8, 8, 3, std::vector<unsigned char>(192, 77))},
                                    {"a.hdr", encode_hdr(float_image(9, 9))}})
    for (int i = 0; i < 400; i++) {
      state = state * 1664525u + 1013904223u;
      std::string changed = bytes;
      changed[(state >> 8) % changed.size()] = static_cast<char>(state >> 24);
      errors_of_file(folder, name, changed);
    }
}

TEST_CASE("textures: files that claim more pixels than they can hold are refused at once") {
  const TempDir folder;
  std::string bomb = png(8, 8, 3, std::vector<unsigned char>(192, 7));
  put_number(bomb, 16, 16000, 4);  // width
  put_number(bomb, 20, 16000, 4);  // height
  CHECK(errors_of_file(folder, "bomb.png", bomb).find("claims 16000 x 16000 pixels") !=
        std::string::npos);
  bomb = jpeg(16, 16);
  const std::size_t frame = bomb.find("\xff\xc0");
  REQUIRE(frame != std::string::npos);
  put_number(bomb, frame + 5, 60000, 2);  // height, then width
  put_number(bomb, frame + 7, 60000, 2);
  CHECK(errors_of_file(folder, "bomb.jpg", bomb).find("claims 60000 x 60000 pixels") !=
        std::string::npos);
  CHECK(errors_of_file(folder, "bomb.hdr",
                       "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 90000 +X 90000\n")
            .find("claims 90000 x 90000 pixels") != std::string::npos);
  bomb = encode_exr(float_image(4, 4));
  const std::size_t window = bomb.find("dataWindow");
  REQUIRE(window != std::string::npos);
  bomb.replace(window + 21 + 8, 4,
               std::string("\xfe\xff\x0f\x00", 4));  // right edge, little-endian
  CHECK(errors_of_file(folder, "bomb.exr", bomb).find("claims 1048575 x 4 pixels") !=
        std::string::npos);
}

TEST_CASE("textures: numbers that are not finite are refused, with their place") {
  const TempDir folder;
  for (const float value :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -2e36f}) {
    Image image = float_image(4, 3);
    image.channels[1].values[6] = value;
    const std::string errors = errors_of_file(folder, "bad.exr", encode_exr(image));
    CHECK(errors.find("at pixel (2, 1); numbers must be finite") != std::string::npos);
  }
  Image depth = make_image(2, 2);
  add_channel(depth, "Z");
  CHECK(errors_of_file(folder, "depth.exr", encode_exr(depth))
            .find("expected channels R, G, B or Y") != std::string::npos);
  std::filesystem::create_directory(folder / "folder.png");
  CHECK(build(scene_text(image_texture("folder.png")), folder.path())
            .errors.find("is no regular file") != std::string::npos);
  CHECK(errors_of_file(folder, "text.png", "this is no picture")
            .find("not a PNG or JPEG that can be read") != std::string::npos);
}

TEST_CASE("textures: pictures of numbers that are decoded from sRGB are a warning") {
  const auto num_warnings = [](const std::string &more) {
    Diagnostics diagnostics;
    parse_scene_text(
        R"({"version": 1, "textures": [)" + image_texture("tiles.png", more) +
            R"(], "materials": [{"name": "m", "type": "conductor", "roughness": "t"}]})",
        "scene.json", source_path("tests/scene/valid"), diagnostics);
    CHECK(!diagnostics.has_errors());
    return diagnostics.warnings().size();
  };
  CHECK(num_warnings("") == 1);
  CHECK(num_warnings(R"(, "colour_space": "linear")") == 0);
  CHECK(num_warnings(R"(, "channel": "a")") == 0);  // alpha is never decoded
}

namespace {

/// One mesh with a material that has textures, colours, both or none.
Scene mesh_scene(const std::string &mesh, bool image, bool painted, const std::string &folder) {
  const std::string texture = image ? R"("t")" : "0.5", opacity = painted ? R"("c")" : "1";
  return build_good(
      R"({"version": 1, "textures": [{"name": "t", "type": "checker"},
      {"name": "c", "type": "vertex_colour"}],
    "materials": [{"name": "m", "type": "diffuse", "reflectance": )" +
          texture + R"(, "opacity": )" + opacity +
          R"(}], "shapes": [{"type": "sphere", "material": "m", "center": [9, 9, 9], "radius": 1},
      {"type": "mesh", "material": "m", "positions": [9, 0, 0, 10, 0, 0, 9, 1, 0], "indices": [0, 1, 2]},
      {"type": "mesh", "material": "m", )" +
          mesh + "}]}",
      folder);
}

}  // namespace

TEST_CASE("mesh data: uvs and colours are kept where the material uses them") {
  const std::string mesh = R"("positions": [0, 0, 0, 1, 0, 0, 0, 1, 0], "indices": [0, 1, 2],
    "uvs": [[0, 0.25], [1, 0], [0.5, 2]], "colours": [1, 0, 0, 0, 0.5, 0, 0, 0, 4])";
  for (const bool image : {false, true})
    for (const bool painted : {false, true}) {
      const Scene scene = mesh_scene(mesh, image, painted, ".");
      const Geometry &other = scene.geometries[1], &g = scene.geometries[2];
      CHECK((other.has_uvs == 0 && other.has_colours == 0));
      const bool has_uvs = g.has_uvs != 0, has_colours = g.has_colours != 0;
      REQUIRE(has_uvs == (image || painted));
      REQUIRE(has_colours == painted);
      if (has_uvs) {
        CHECK(scene.vertex_uvs == std::vector<float>{0, 0.25f, 1, 0, 0.5f, 2});
        CHECK(g.uv_offset == -3);  // three vertices of another mesh come before
      }
      if (has_colours) {
        CHECK(scene.vertex_colours == std::vector<float>{1, 0, 0, 0, 0.5f, 0, 0, 0, 4});
        CHECK(g.colour_offset == -3);
      }
    }
}

TEST_CASE("mesh data: OBJ vertices are split by texture coordinates, if they are wanted") {
  const TempDir folder;
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
      "vt 0 0\nvt 1 0 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\nvn 0 0 1\n";
  put(folder / "square.obj", text + "f 1/1/1 2/2/1 3/3/1\nf 1/5/1 3/-3/1 4/4/1\n");
  put(folder / "bare.obj", text + "f 1/1 2/2 3/3\nf 1/5 3/3 4/4\n");
  for (const char *file : {"square.obj", "bare.obj"}) {
    const std::string mesh = R"("file": ")" + std::string(file) + "\"";
    const Scene plain = mesh_scene(mesh, false, false, folder.path());
    CHECK(plain.num_vertices() == 3 + 4);
    CHECK(plain.vertex_uvs.empty());
    const Scene scene = mesh_scene(mesh, true, false, folder.path());
    CHECK(scene.num_vertices() == 3 + 5);
    CHECK(scene.vertex_uvs == std::vector<float>{0, 0, 1, 0, 1, 1, 0.5f, 0.5f, 0, 1});
    const bool has_normals = scene.geometries[2].has_normals != 0;
    CHECK(has_normals == (std::string(file) == "square.obj"));
  }
  const auto errors = [&](const std::string &obj) {
    put(folder / "bad.obj", obj);
    return build(R"({"version": 1, "textures": [{"name": "t", "type": "checker"}],
      "materials": [{"name": "m", "type": "diffuse", "reflectance": "t"}],
      "shapes": [{"type": "mesh", "material": "m", "file": "bad.obj"}]})",
                 folder.path())
        .errors;
  };
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  CHECK(errors(corners + "vt 0 zero\nf 1/1 2/1 3/1\n")
            .find("bad.obj:4: texture coordinate 1: 'zero'") != std::string::npos);
  CHECK(errors(corners + "vt 0\nf 1/1 2/1 3/1\n").find("1 numbers, expected 2") !=
        std::string::npos);
  CHECK(errors(corners + "vt 0 0\nf 1/1 2/2 3/1\n").find("texture coordinate 2 does not exist") !=
        std::string::npos);
  CHECK(errors(corners + "vt 0 0\nf 1/1 2/-2 3/1\n").find("texture coordinate 0 does not exist") !=
        std::string::npos);
  CHECK(errors(corners + "vt 0 0\nf 1/1 2 3/1\n") == "");  // a warning: no uvs
}

TEST_CASE("mesh data: PLY has texture coordinates and colours by several names") {
  const TempDir folder;
  const auto ply = [](const std::string &properties, const std::array<const char *, 3> &rows) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
           "float z\n" +
           properties +
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " + rows[0] +
           "\n1 0 0 " + rows[1] + "\n0 1 0 " + rows[2] + "\n3 0 1 2\n";
  };
  const std::array<const char *, 3> rows = {"255 0 188 0 0.25", "0 255 0 1 0", "0 0 255 0.5 2"};
  for (const auto &[u, v] : {std::pair<std::string, std::string>{"u", "v"},
                             {"s", "t"},
                             {"texture_u", "texture_v"},
                             {"texture_s", "texture_t"}}) {
    put(folder / "mesh.ply",
        ply("property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float " + u +
                "\nproperty double " + v + "\n",
            rows));
    const Scene scene = mesh_scene(R"("file": "mesh.ply")", true, true, folder.path());
    CHECK(scene.vertex_uvs == std::vector<float>{0, 0.25f, 1, 0, 0.5f, 2});
    const float pink = static_cast<float>(linear_from_srgb(188 / 255.0));
    CHECK(scene.vertex_colours == std::vector<float>{1, 0, pink, 0, 1, 0, 0, 0, 1});
    const Scene plain = mesh_scene(R"("file": "mesh.ply")", false, false, folder.path());
    CHECK(plain.vertex_uvs.empty());
    CHECK(plain.vertex_colours.empty());
  }
  const std::string floats = "property float red\nproperty float green\nproperty float blue\n";
  put(folder / "mesh.ply", ply(floats, {"0.5 0 3", "0 1 0", "0 0 1"}));
  const Scene scene = mesh_scene(R"("file": "mesh.ply")", true, true, folder.path());
  CHECK(scene.vertex_uvs.empty());
  CHECK(scene.vertex_colours == std::vector<float>{0.5f, 0, 3, 0, 1, 0, 0, 0, 1});
  put(folder / "mesh.ply", ply(floats, {"0.5 0 3", "0 -1 0", "0 0 1"}));
  Diagnostics diagnostics;
  parse_scene_text(R"({"version": 1, "textures": [{"name": "c", "type": "vertex_colour"}],
    "materials": [{"name": "m", "type": "diffuse", "reflectance": "c"}],
    "shapes": [{"type": "mesh", "material": "m", "file": "mesh.ply"}]})",
                   "scene.json", folder.path(), diagnostics);
  CHECK(errors_of(diagnostics).find("vertex 1: green is negative") != std::string::npos);
}
