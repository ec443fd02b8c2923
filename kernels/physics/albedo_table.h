// Directional albedos that have no closed form, looked up in tables made at load
// (src/scene/albedo_tables.h).
//
// A table is PHALANX_ALBEDO_ROWS rows of PHALANX_ALBEDO_COLUMNS numbers, then one average per row.
// Columns are equal steps of sqrt(mu) from 0 to 1: fine where Fresnel is steep. What a row is, a
// coordinate in [0,1], is up to the table: mostly sqrt(alpha). Between its numbers a table is linear.
#pragma once
#include "../scene_view.h"

PHALANX_BEGIN

#define PHALANX_ALBEDO_ROWS 64
#define PHALANX_ALBEDO_COLUMNS 64
#define PHALANX_ALBEDO_FLOATS (PHALANX_ALBEDO_ROWS * (PHALANX_ALBEDO_COLUMNS + 1))

/// Which cell a coordinate in [0,1] falls into, and where in it.
struct TableCell {
  int32 index;  // in [0, size - 2]
  float at;     // in [0,1]
};

PHYS TableCell table_cell(float coordinate, int32 size) {
  const float x = clamp_to(coordinate, 0.0f, 1.0f) * to_float(size - 1);
  TableCell c;
  c.index = to_int(min_of(x, to_float(size) - 1.5f));
  c.at = x - to_float(c.index);
  return c;
}

PHYS float between(float a, float b, float t) { return a + (b - a) * t; }

/// Albedo in direction mu, the cosine to the normal. table: its first float in SceneView::tables.
PHYS float directional_albedo(const UNI SceneView &scene, int32 table, float row, float mu) {
  const TableCell r = table_cell(row, PHALANX_ALBEDO_ROWS);
  const TableCell c = table_cell(safe_sqrt(mu), PHALANX_ALBEDO_COLUMNS);
  const int32 i = table + r.index * PHALANX_ALBEDO_COLUMNS + c.index;
  const int32 j = i + PHALANX_ALBEDO_COLUMNS;
  return between(between(scene.tables[i], scene.tables[i + 1], c.at),
                 between(scene.tables[j], scene.tables[j + 1], c.at), r.at);
}

/// Average of the row over the hemisphere, weighted with the cosine: 2 int E mu dmu.
PHYS float average_albedo(const UNI SceneView &scene, int32 table, float row) {
  const TableCell r = table_cell(row, PHALANX_ALBEDO_ROWS);
  const int32 i = table + PHALANX_ALBEDO_ROWS * PHALANX_ALBEDO_COLUMNS + r.index;
  return between(scene.tables[i], scene.tables[i + 1], r.at);
}

PHALANX_END
