// A scene as its author wrote it: plain data, checked, with every name resolved to an index.
//
// scene_file.h fills it from JSON; build.h turns it into the arrays that kernels read. Lengths are
// metres, angles degrees, radiance W sr^-1 m^-2, colours linear RGB.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "../../kernels/scene_view.h"
#include "../core/error.h"

namespace phalanx {

using Double3 = std::array<double, 3>;

/// Affine map, rows of (linear | translation).
struct Transform {
  double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

struct CameraDescription {
  Double3 position = {0, 0, 0};
  Double3 look_at = {0, 0, -1};
  Double3 up = {0, 1, 0};
  double fov = 45;              // full vertical angle, degrees, in (0, 180)
  double aperture_radius = 0;   // metres; 0 is a pinhole
  double focus_distance = 0;    // metres; 0 means |look_at - position|
  CameraKind kind = kPerspective;
  int blades = 0;               // of the iris; 0: round
  double blade_rotation = 0;    // degrees, counter-clockwise in the picture's right and up
  double height = 2;            // orthographic: of the picture, metres
  double angle = 180;           // fisheye: over the picture's height, degrees, in (0, 360]
};

struct FilmDescription {
  int width = 512, height = 512;
  FilterKind filter = kBlackmanHarrisFilter;
  double filter_radius = 1.5;   // pixels
  double filter_sigma = 0.5;    // pixels, Gaussian only
  std::array<int, 4> crop = {0, 0, 0, 0};  // x, y, width, height; width 0 = whole picture
  double exposure = 0;          // stops, for PNG output only
};

struct SamplerDescription {
  SamplerKind kind = kSobolSampler;
  int spp = 64;                 // samples per pixel
  int seed = 0;
};

/// How one of several lights is chosen, and a point on it.
enum class LightChoice { kAuto, kPower, kUniform, kTree };
enum class LightPoints { kArea, kSolidAngle };

struct IntegratorDescription {
  IntegratorKind kind = kPathIntegrator;
  double distance = static_cast<double>(PHALANX_FAR);  // ambient occlusion: how far is looked, metres
  int max_depth = 16;           // scattering events after the camera
  int roulette_depth = 4;       // Russian roulette from this event on
  LightChoice light_choice = LightChoice::kAuto;
  LightPoints light_points = LightPoints::kArea;
};

/// A picture or a pattern. Images are read when the scene is built (build_textures.h).
struct TextureDescription {
  std::string name;
  TextureKind kind = kConstantTexture;
  Double3 a = {1, 1, 1};                  // image, vertex colours: tint. Else a colour
  Double3 b = {0, 0, 0};                  // checker, marble, noise: the other colour
  int channel = 4;                        // 0 to 3: red to alpha; 4: luminance
  double to_texture[2][3] = {{1, 0, 0}, {0, 1, 0}};  // from the surface's uv
  std::string file;                       // image: its path
  Problem file_place;                     // and who asks for it, for messages
  bool srgb = false;                      // image: its numbers are sRGB-encoded
  WrapMode wrap_u = kRepeat, wrap_v = kRepeat;
  bool nearest = false;                   // no interpolation between texels
  double scale = 0;                       // marble, noise, solid checker: cells per metre
  double turbulence = 1;                  // marble: how far noise shifts its stripes, in stripes
  int octaves = 6;                        // marble, noise
};

/// Where parameters of a material come from instead: indices into textures, -1 for none.
struct MaterialTextures {
  std::int32_t reflectance = -1, specular = -1, transmittance = -1, roughness = -1;
  std::int32_t metallic = -1, transmission = -1, clearcoat = -1, sheen = -1;
  std::int32_t emission = -1, weight = -1, opacity = -1, normal = -1, bump = -1;
};

struct MaterialDescription {
  std::string name;
  MaterialKind kind = kDiffuse;
  Double3 reflectance = {0.5, 0.5, 0.5};  // diffuse albedo, or F0
  bool has_ior = false;                   // conductor: use eta and k instead of reflectance
  Double3 eta = {1, 1, 1}, k = {0, 0, 0};
  double roughness = 0;                   // perceptual, alpha = roughness^2; rough_diffuse: sigma
  bool anisotropic = false;               // conductor: roughness_x, roughness_y instead of roughness
  double roughness_x = 0, roughness_y = 0;  // along the tangent, and across
  bool multiple_scattering = false;       // conductor: what bounces between microfacets is not lost
  double ior = 1.5;                       // dielectric, coat
  Double3 specular = {1, 1, 1};           // tint of reflection: dielectrics, coats
  Double3 transmittance = {1, 1, 1};      // tint of transmission: dielectrics
  double exponent = 10;                   // phong, blinn_phong
  // hair: absorption per radius instead of reflectance; tilt of its scales, degrees
  bool has_absorption = false;
  Double3 absorption = {0, 0, 0};
  double azimuthal_roughness = 0, tilt = 2;
  // principled
  double specular_level = 1, metallic = 0, transmission = 0;
  double clearcoat = 0, clearcoat_roughness = 0;
  Double3 sheen = {0, 0, 0};
  double sheen_roughness = 0.5;
  // kBlend: indices into materials; b with probability weight, else a
  std::int32_t blend_a = -1, blend_b = -1;
  double weight = 0.5;
  bool is_null = false;                   // light passes as if there were no surface
  bool one_sided = false;                 // scattering: the back absorbs
  Double3 emission = {0, 0, 0};           // times the texture, if there is one
  bool two_sided = false;                 // emission on both sides
  double opacity = 1;                     // in [0, 1]
  double normal_scale = 1;                // strength of the normal map
  double bump_scale = 0.01;               // metres from black to white of the bump map
  MaterialTextures textures;
};

inline bool is_blend(const MaterialDescription &material) {
  return static_cast<int>(material.kind) == kBlend;
}

// ---- shapes -----------------------------------------------------------------------------------

/// Triangles with positions and, unless empty, one normal, uv, colour per vertex.
struct MeshData {
  std::vector<float> positions;         // [num_vertices * 3]
  std::vector<float> normals;           // [num_vertices * 3] or empty
  std::vector<std::int32_t> indices;    // [num_triangles * 3]
  std::vector<float> uvs;               // [num_vertices * 2] or empty
  std::vector<float> colours;           // [num_vertices * 3] or empty
};

/// Which of these a mesh's material can use. The others are not kept.
struct MeshNeeds {
  bool uvs = false, colours = false;
};

struct MeshShape {
  MeshData data;                        // inline, or read from a file, or generated
};
/// Parallelogram. Emits and faces along edge_u x edge_v.
struct QuadShape {
  Double3 corner, edge_u, edge_v;
};
/// A set of spheres: one from the file, or many from a generator (sphere flake).
struct SpheresShape {
  std::vector<std::array<double, 4>> spheres;  // x, y, z, radius
};
struct DiskShape {
  Double3 center, normal;
  double radius = 1;
};
/// Strands of hair: polylines, each with a radius that changes from point to point.
struct CurvesShape {
  std::vector<std::array<double, 4>> points;  // x, y, z, radius; strand after strand
  std::vector<std::int32_t> sizes;            // points of each strand, at least 2

  void add(const std::vector<std::array<double, 4>> &strand);
};

using ShapeGeometry = std::variant<MeshShape, QuadShape, SpheresShape, DiskShape, CurvesShape>;

struct ShapeDescription {
  std::string origin;                   // for messages: "scene.json: /shapes/3"
  std::int32_t material = 0;            // index into materials
  Transform transform;
  ShapeGeometry shape;
};

/// Shapes that instances place.
struct GroupDescription {
  std::string name;
  std::vector<ShapeDescription> shapes;
};
struct InstanceDescription {
  std::int32_t group = 0;               // index into groups
  Transform transform;                  // when the shutter opens
  std::string origin;
  std::optional<Transform> transform_end;  // when it closes, if it moves
};

// ---- lights that are no surfaces ----------------------------------------------------------------

struct LightDescription {
  LightKind kind = kPointLight;         // point, spot or directional
  std::string origin;                   // for messages: "scene.json: /lights/3"
  Double3 emission = {1, 1, 1};         // intensity, W sr^-1; directional: irradiance, W m^-2
  Double3 position = {0, 0, 0};
  Double3 direction = {0, -1, 0};       // of the light's way; a profile's vertical angle 0
  double inner_angle = 20, outer_angle = 30;  // spot: from the axis, degrees
  double angular_diameter = 0;          // directional: of its disc, degrees; 0: one direction only
  std::string profile;                  // path of an IES file, or ""
  bool profile_intensity = false;       // the IES file says how bright it is, not emission
  Double3 horizontal = {1, 0, 0};       // horizontal angle 0 of the profile
};

/// A picture in latitude and longitude, all around.
struct EnvironmentMapDescription {
  std::string file, origin;
  double rotation = 0;                  // about +y, degrees, counter-clockwise seen from above
  Double3 scale = {1, 1, 1};
};

struct SkyDescription {
  double turbidity = 3;
  Double3 sun_direction = {0, 1, 0};    // unit, to the sun
  Double3 ground_albedo = {0.3, 0.3, 0.3};
  double angular_diameter = 0.533;      // of the sun, degrees
  bool sun = true;                      // false: the sky without the disc
  double scale = 1;
};

struct SceneDescription {
  std::string file;
  Double3 origin = {0, 0, 0};           // what recentre.h has taken off all coordinates, metres
  CameraDescription camera;
  FilmDescription film;
  SamplerDescription sampler;
  IntegratorDescription integrator;
  std::vector<TextureDescription> textures;
  std::vector<MaterialDescription> materials;
  std::vector<ShapeDescription> shapes;
  std::vector<GroupDescription> groups;
  std::vector<InstanceDescription> instances;
  bool has_environment = false;         // a constant one
  Double3 environment = {0, 0, 0};
  std::optional<EnvironmentMapDescription> environment_map;
  std::optional<SkyDescription> sky;
  std::vector<LightDescription> lights;
};

}  // namespace phalanx
