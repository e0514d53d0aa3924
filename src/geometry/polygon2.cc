// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/geometry/polygon2.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "enfilade/base/check.h"
#include "enfilade/geometry/cross.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// Sign of the turn a → b → c.
int Orientation(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double cross = Cross(b - a, c - a);
  return (cross > 0) - (cross < 0);
}

bool OnSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  return Orientation(a, b, p) == 0 && p.x() >= std::min(a.x(), b.x()) &&
         p.x() <= std::max(a.x(), b.x()) && p.y() >= std::min(a.y(), b.y()) &&
         p.y() <= std::max(a.y(), b.y());
}

// The whole of `text` as a number.
double ParseCoordinate(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  ENFILADE_CHECK_MSG(error == std::errc() && end == text.data() + text.size(), std::string(text));
  return value;
}

std::string CoordinateToText(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

bool SegmentsTouch(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  if (Orientation(a, b, c) * Orientation(a, b, d) < 0 &&
      Orientation(c, d, a) * Orientation(c, d, b) < 0) {
    return true;
  }
  return OnSegment(c, a, b) || OnSegment(d, a, b) || OnSegment(a, c, d) || OnSegment(b, c, d);
}

}  // namespace

double SignedArea(const Ring2& ring) {
  double twice_area = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    // Relative to the first vertex, so that rings far from the origin lose no digits.
    twice_area += Cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  }
  return 0.5 * twice_area;
}

std::vector<Ring2> RingsOf(const Polygon2& polygon) {
  std::vector<Ring2> rings = {polygon.outer};
  rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  return rings;
}

double Area(const Polygon2& polygon) {
  double area = std::abs(SignedArea(polygon.outer));
  for (const Ring2& hole : polygon.holes) area -= std::abs(SignedArea(hole));
  return area;
}

double Area(const MultiPolygon2& region) {
  double area = 0;
  for (const Polygon2& polygon : region) area += Area(polygon);
  return area;
}

double Perimeter(const Ring2& ring) {
  double length = 0;
  for (size_t i = 0; i < ring.size(); ++i) length += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  return length;
}

bool Contains(const Ring2& ring, const Vector2d& p) {
  bool inside = false;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d& a = ring[i];
    const Vector2d& b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

bool Contains(const Polygon2& polygon, const Vector2d& p) {
  return Contains(polygon.outer, p) &&
         std::none_of(polygon.holes.begin(), polygon.holes.end(),
                      [&](const Ring2& hole) { return Contains(hole, p); });
}

double DistanceToSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d ab = b - a;
  const double squared_length = ab.squaredNorm();
  const double t =
      squared_length > 0 ? std::clamp((p - a).dot(ab) / squared_length, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm();
}

double DistanceToRing(const Ring2& ring, const Vector2d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < ring.size(); ++i)
    nearest = std::min(nearest, DistanceToSegment(p, ring[i], ring[(i + 1) % ring.size()]));
  return nearest;
}

double RayDistance(const Ring2& ring, const Vector2d& origin, const Vector2d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d a = ring[i] - origin;
    const Vector2d b = ring[(i + 1) % ring.size()] - origin;
    // A vertex is on the same side for both of its edges, so the edges leave no gap.
    const double side_a = Cross(direction, a), side_b = Cross(direction, b);
    if ((side_a > 0) == (side_b > 0)) continue;
    const double t = side_a / (side_a - side_b);
    const double distance = (1 - t) * direction.dot(a) + t * direction.dot(b);
    if (distance >= 0) nearest = std::min(nearest, distance);
  }
  return nearest;
}

Ring2 RemoveCollinear(const Ring2& ring, double tolerance_m) {
  Ring2 kept = ring;
  for (size_t i = 0; kept.size() > 2 && i < kept.size();) {
    const Vector2d& previous = kept[(i + kept.size() - 1) % kept.size()];
    const Vector2d& next = kept[(i + 1) % kept.size()];
    if (DistanceToSegment(kept[i], previous, next) <= tolerance_m) {
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;
    } else {
      ++i;
    }
  }
  return kept;
}

bool IsSimple(const Ring2& ring) {
  const size_t n = ring.size();
  if (n < 3) return false;
  for (size_t i = 0; i < n; ++i) {
    const Vector2d& a = ring[i];
    const Vector2d& b = ring[(i + 1) % n];
    if (a == b) return false;
    // The next edge shares b: it must not fold back onto this one.
    const Vector2d& c = ring[(i + 2) % n];
    if (Orientation(a, b, c) == 0 && (c - b).dot(a - b) > 0) return false;
    for (size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      if (SegmentsTouch(a, b, ring[j], ring[(j + 1) % n])) return false;
    }
  }
  return true;
}

Ring2 ParseRing(std::string_view text) {
  Ring2 ring;
  std::istringstream stream{std::string(text)};
  std::string vertex;
  while (stream >> vertex) {
    const size_t comma = vertex.find(',');
    ENFILADE_CHECK_MSG(comma != std::string::npos, vertex);
    const std::string_view view = vertex;
    ring.emplace_back(ParseCoordinate(view.substr(0, comma)),
                      ParseCoordinate(view.substr(comma + 1)));
  }
  return ring;
}

std::string RingToText(const Ring2& ring) {
  std::string text;
  for (const Vector2d& p : ring) {
    if (!text.empty()) text += ' ';
    text += CoordinateToText(p.x()) + ',' + CoordinateToText(p.y());
  }
  return text;
}

}  // namespace enfilade
