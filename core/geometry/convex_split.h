#pragma once
/// Cutting convex polygons by straight lines so that the two neighbours of every edge always agree to the last bit.
///
/// Every cut leaves a chord, and the boundary between any two pieces lies on the one chord whose cut parted their
/// ancestors. A later line meets the chord at a point computed from the chord's own ends, never from the ends of what is
/// left of it, and the chord remembers the point: whoever cuts the chord there, now or later, from either side, gets the same
/// bits, whether or not the neighbour was cut too.

#include "core/geometry/convex_part.h"
#include "core/geometry/polygon.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hdem
{
/// Straight line through `point` along the unit vector `direction`.
struct CutLine
{
    Vec2 point = {0.0, 0.0};      ///< [m]
    Vec2 direction = {1.0, 0.0};  ///< [-]

    /// Distance of p from the line, positive on its left [m].
    [[nodiscard]] double side(const Vec2& p) const { return cross(direction, p - point); }
};

/// Where an edge came from: its source is the user's (joint set, outline, ...), its chord says which edges lie on one line.
struct EdgeTag
{
    std::int32_t source = 0;
    Index chord = no_index;

    friend bool operator==(const EdgeTag&, const EdgeTag&) = default;
};

/// Anticlockwise; edge i runs from vertex i to vertex i+1.
struct CutPolygon
{
    Polygon vertices;            ///< [m]
    std::vector<EdgeTag> edges;  ///< one per vertex

    void add(const Vec2& vertex, const EdgeTag& edge)
    {
        vertices.push_back(vertex);
        edges.push_back(edge);
    }
};

/// All segments that polygons were cut along, with the points found on them.
class Chords
{
  public:
    Index add(const Vec2& from, const Vec2& to);

    /// Distance of p from the chord's first end, along the chord [m].
    [[nodiscard]] double position(Index chord, const Vec2& p) const;

    /// Where a line meets a chord: a point recorded there within `tolerance` of the line, or a new one.
    /// @pre the chord's ends lie on different sides of the line
    [[nodiscard]] Vec2 crossing(Index chord, const CutLine& line, double tolerance) const;

    /// From now on crossing() returns this point for lines through it.
    void record(Index chord, const Vec2& p);

  private:
    struct Point
    {
        double position;
        Vec2 at;
    };
    struct Chord
    {
        Vec2 from;
        Vec2 to;
        std::vector<Point> points;  // in order of position
    };
    std::vector<Chord> chords_;
};

enum class Side
{
    left,
    right,
    crossed
};

/// On which side of a line a polygon lies; vertices nearer to the line than `tolerance` are on both sides.
Side side_of(const Polygon& polygon, const CutLine& line, double tolerance);

/// A cut not yet made: the caller may look at the pieces and drop it.
struct ConvexCut
{
    struct NewPoint
    {
        Index chord = no_index;
        Vec2 at = {0.0, 0.0};
    };

    CutPolygon left;
    CutPolygon right;
    Vec2 from = {0.0, 0.0};  ///< ends of the new chord [m]
    Vec2 to = {0.0, 0.0};
    std::array<NewPoint, 2> new_points;  ///< where the line met existing edges; chord = no_index: at a vertex
};

/// Pieces of a convex polygon left and right of a line. The new edge has the given source and no chord yet; a line nearer than
/// `tolerance` to a vertex goes through the vertex.
/// @pre side_of(polygon, line, tolerance) == Side::crossed, and every edge has a chord
ConvexCut plan_cut(const CutPolygon& polygon, const CutLine& line, std::int32_t source, const Chords& chords, double tolerance);

/// Make the cut: its chord and points enter `chords`, its new edges know their chord. Returns the new chord.
Index commit(ConvexCut& cut, Chords& chords);

/// Give every edge without a chord one: opposite edges with the same ends share theirs.
void give_chords(std::vector<CutPolygon>& parts, Chords& chords);
}  // namespace hdem
