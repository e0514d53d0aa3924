// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/boolean.h"

#include <geos_c.h>

#include <algorithm>
#include <memory>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

constexpr double kMinPartArea_m2 = 1e-9;
constexpr int kQuadrantSegments = 32;

// One context a call: GEOS contexts are not shared between threads.
class Geos {
 public:
  Geos() : context_(GEOS_init_r()) { ENFILADE_CHECK(context_ != nullptr); }
  ~Geos() { GEOS_finish_r(context_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  struct Deleter {
    GEOSContextHandle_t context;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(context, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Deleter>;

  [[nodiscard]] GEOSContextHandle_t handle() const { return context_; }

  // Takes ownership; a null pointer means that GEOS failed on input that it must handle.
  [[nodiscard]] Geometry Own(GEOSGeometry* geometry) const {
    ENFILADE_CHECK(geometry != nullptr);
    return {geometry, Deleter{context_}};
  }

  [[nodiscard]] Geometry FromRegion(const MultiPolygon2& region) const {
    std::vector<GEOSGeometry*> parts;
    for (const Polygon2& polygon : region) {
      if (polygon.outer.size() >= 3) ClonePolygons(FromPolygon(polygon).get(), parts);
    }
    const Geometry raw = Own(GEOSGeom_createCollection_r(context_, GEOS_MULTIPOLYGON, parts.data(),
                                                         static_cast<unsigned>(parts.size())));
    return Own(GEOSUnaryUnion_r(context_, raw.get()));
  }

  [[nodiscard]] MultiPolygon2 ToRegion(const GEOSGeometry* geometry) const {
    MultiPolygon2 region;
    const int num_parts = GEOSGetNumGeometries_r(context_, geometry);
    for (int i = 0; i < num_parts; ++i) {
      const GEOSGeometry* part = GEOSGetGeometryN_r(context_, geometry, i);
      if (GEOSGeomTypeId_r(context_, part) == GEOS_GEOMETRYCOLLECTION) {
        for (Polygon2& polygon : ToRegion(part)) region.push_back(std::move(polygon));
      } else if (GEOSGeomTypeId_r(context_, part) == GEOS_POLYGON &&
                 GEOSisEmpty_r(context_, part) == 0) {
        Polygon2 polygon = ToPolygon(part);
        if (Area(polygon) > kMinPartArea_m2) region.push_back(std::move(polygon));
      }
    }
    return region;
  }

 private:
  [[nodiscard]] GEOSGeometry* FromRing(const Ring2& ring) const {
    const unsigned size = static_cast<unsigned>(ring.size()) + 1;
    GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context_, size, 2);
    for (unsigned i = 0; i < size; ++i) {
      const Eigen::Vector2d& p = ring[i % ring.size()];
      GEOSCoordSeq_setXY_r(context_, sequence, i, p.x(), p.y());
    }
    return GEOSGeom_createLinearRing_r(context_, sequence);
  }

  [[nodiscard]] Geometry FromPolygon(const Polygon2& polygon) const {
    std::vector<GEOSGeometry*> holes;
    for (const Ring2& hole : polygon.holes) {
      if (hole.size() >= 3) holes.push_back(FromRing(hole));
    }
    const Geometry raw = Own(GEOSGeom_createPolygon_r(
        context_, FromRing(polygon.outer), holes.data(), static_cast<unsigned>(holes.size())));
    return Own(GEOSMakeValid_r(context_, raw.get()));
  }

  // Making a ring valid may leave lines where it folds back or has no area: only polygons are kept.
  void ClonePolygons(const GEOSGeometry* geometry, std::vector<GEOSGeometry*>& polygons) const {
    const int type = GEOSGeomTypeId_r(context_, geometry);
    if (type == GEOS_POLYGON) polygons.push_back(GEOSGeom_clone_r(context_, geometry));
    if (type != GEOS_MULTIPOLYGON && type != GEOS_GEOMETRYCOLLECTION) return;
    for (int i = 0; i < GEOSGetNumGeometries_r(context_, geometry); ++i) {
      ClonePolygons(GEOSGetGeometryN_r(context_, geometry, i), polygons);
    }
  }

  [[nodiscard]] Ring2 ToRing(const GEOSGeometry* geometry, bool counter_clockwise) const {
    const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context_, geometry);
    unsigned size = 0;
    GEOSCoordSeq_getSize_r(context_, sequence, &size);
    Ring2 ring(size > 0 ? size - 1 : 0);  // GEOS repeats the first vertex
    for (unsigned i = 0; i + 1 < size; ++i) {
      GEOSCoordSeq_getXY_r(context_, sequence, i, &ring[i].x(), &ring[i].y());
    }
    if ((SignedArea(ring) > 0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
    return ring;
  }

  [[nodiscard]] Polygon2 ToPolygon(const GEOSGeometry* geometry) const {
    Polygon2 polygon;
    polygon.outer = ToRing(GEOSGetExteriorRing_r(context_, geometry), true);
    const int num_holes = GEOSGetNumInteriorRings_r(context_, geometry);
    for (int i = 0; i < num_holes; ++i) {
      polygon.holes.push_back(ToRing(GEOSGetInteriorRingN_r(context_, geometry, i), false));
    }
    return polygon;
  }

  GEOSContextHandle_t context_;
};

using BinaryOperation = GEOSGeometry* (*)(GEOSContextHandle_t, const GEOSGeometry*,
                                          const GEOSGeometry*);

MultiPolygon2 Apply(BinaryOperation operation, const MultiPolygon2& a, const MultiPolygon2& b) {
  const Geos geos;
  const Geos::Geometry geometry_a = geos.FromRegion(a);
  const Geos::Geometry geometry_b = geos.FromRegion(b);
  return geos.ToRegion(
      geos.Own(operation(geos.handle(), geometry_a.get(), geometry_b.get())).get());
}

}  // namespace

MultiPolygon2 Union(const MultiPolygon2& a, const MultiPolygon2& b) {
  return Apply(GEOSUnion_r, a, b);
}

MultiPolygon2 Intersection(const MultiPolygon2& a, const MultiPolygon2& b) {
  return Apply(GEOSIntersection_r, a, b);
}

MultiPolygon2 Difference(const MultiPolygon2& a, const MultiPolygon2& b) {
  return Apply(GEOSDifference_r, a, b);
}

MultiPolygon2 Offset(const MultiPolygon2& region, double distance_m) {
  const Geos geos;
  const Geos::Geometry geometry = geos.FromRegion(region);
  return geos.ToRegion(
      geos.Own(GEOSBuffer_r(geos.handle(), geometry.get(), distance_m, kQuadrantSegments)).get());
}

MultiPolygon2 OffsetSharp(const MultiPolygon2& region, double distance_m) {
  constexpr double kLongestMitre = 5;  // times the distance; sharper corners are cut off
  const Geos geos;
  const Geos::Geometry geometry = geos.FromRegion(region);
  // GEOS 3.11 gives up on corners that fold back, which edges leave that miss each other by a
  // rounding error: on a grid they do not, or else on a coarser one.
  GEOSGeometry* offset = nullptr;
  for (const double grid_m : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const Geos::Geometry snapped =
        geos.Own(GEOSGeom_setPrecision_r(geos.handle(), geometry.get(), grid_m, 0));
    offset = GEOSBufferWithStyle_r(geos.handle(), snapped.get(), distance_m, kQuadrantSegments,
                                   GEOSBUF_CAP_FLAT, GEOSBUF_JOIN_MITRE, kLongestMitre);
    if (offset != nullptr) break;
  }
  return geos.ToRegion(geos.Own(offset).get());
}

MultiPolygon2 CloseRegion(const MultiPolygon2& region, double radius_m, double max_hole_m2) {
  MultiPolygon2 closed = Offset(Offset(region, radius_m), -radius_m);
  for (Polygon2& polygon : closed) {
    std::erase_if(polygon.holes,
                  [&](const Ring2& hole) { return std::abs(SignedArea(hole)) < max_hole_m2; });
  }
  return Union(closed);  // a filled hole may have held another part
}

double AreaIou(const MultiPolygon2& a, const MultiPolygon2& b) {
  const double area_union = Area(Union(a, b));
  return area_union > 0 ? Area(Intersection(a, b)) / area_union : 1.0;
}

}  // namespace enfilade
