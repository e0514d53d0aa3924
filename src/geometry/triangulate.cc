// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/triangulate.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <deque>

#include "enfilade/base/check.h"

namespace enfilade {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
constexpr int kUnvisited = -1;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

void InsertRing(const Ring2& ring, Cdt& cdt, std::vector<Eigen::Vector2d>& vertices) {
  std::vector<Cdt::Vertex_handle> handles;
  for (const Eigen::Vector2d& p : ring) {
    ENFILADE_CHECK(p.allFinite());
    handles.push_back(cdt.insert({p.x(), p.y()}));
    handles.back()->info() = static_cast<int>(vertices.size());
    vertices.push_back(p);
  }
  // CGAL crashes on a constraint from a vertex to itself.
  ENFILADE_CHECK_MSG(cdt.number_of_vertices() == vertices.size(), "a vertex is repeated");
  try {
    for (size_t i = 0; i < handles.size(); ++i) {
      cdt.insert_constraint(handles[i], handles[(i + 1) % handles.size()]);
    }
  } catch (const Cdt::Intersection_of_constraints_exception&) {
    ENFILADE_CHECK_MSG(false, "edges cross");
  }
}

// Depth of each face: how many constrained edges separate it from the infinite face. Odd is inside.
void MarkDepth(Cdt& cdt) {
  for (auto face = cdt.all_faces_begin(); face != cdt.all_faces_end(); ++face) {
    face->info() = kUnvisited;
  }
  std::deque<Cdt::Face_handle> border{cdt.infinite_face()};
  cdt.infinite_face()->info() = 0;
  while (!border.empty()) {
    const Cdt::Face_handle face = border.front();
    border.pop_front();
    for (int i = 0; i < 3; ++i) {
      const Cdt::Face_handle neighbour = face->neighbor(i);
      if (neighbour->info() != kUnvisited) continue;
      const bool crosses = cdt.is_constrained({face, i});
      neighbour->info() = face->info() + (crosses ? 1 : 0);
      // Faces of equal depth first: a 0-1 breadth-first search.
      crosses ? border.push_back(neighbour) : border.push_front(neighbour);
    }
  }
}

}  // namespace

Triangulation2 Triangulate(const Polygon2& polygon) {
  ENFILADE_CHECK(polygon.outer.size() >= 3);
  Triangulation2 result;
  Cdt cdt;
  InsertRing(polygon.outer, cdt, result.vertices);
  for (const Ring2& hole : polygon.holes) InsertRing(hole, cdt, result.vertices);
  MarkDepth(cdt);
  for (auto face = cdt.finite_faces_begin(); face != cdt.finite_faces_end(); ++face) {
    if (face->info() % 2 == 0) continue;
    result.triangles.push_back(
        {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }
  return result;
}

}  // namespace enfilade
