#include "systems/models/metal_shell/dent/fold_cells.hpp"

#include <algorithm>

namespace cullet {
namespace {

constexpr float kFoldHeight = 0.5f, kMostShortening = 0.5f, kLeastShortening = 1e-4f;
constexpr float kCrease = 0.35f, kFoldedCrease = 0.6f;
constexpr float kFullTurn = 0.1f;  // rad between neighbours, from which on a crease is full
constexpr float kFullHold = 0.5f;  // of the greatest field: from there on sub-shells move all the way
constexpr double kMostTurn = 1;    // rad, of a rigid fit

/// Of an element, by its corners.
struct Place {
    Vec3d centroid;
    double area;
};
Place start_of(const MetalView& metal, uint32_t e) {
    const auto& c = metal.corners(e);
    const MetalVertices& v = metal.vertices();
    Vec3d q[3];
    for (int k = 0; k < 3; ++k) q[k] = Vec3d(v.start[metal.vertex(c[k])]);
    return {(1.0 / 3) * (q[0] + q[1] + q[2]), 0.5 * length(cross(q[1] - q[0], q[2] - q[0]))};
}
/// How far the centroid went.
Vec3d way_of(const MetalView& metal, uint32_t e, const Place& start) {
    const auto& c = metal.corners(e);
    const MetalVertices& v = metal.vertices();
    Vec3d x[3];
    for (int k = 0; k < 3; ++k) x[k] = Vec3d(v.place[metal.vertex(c[k])]);
    return (1.0 / 3) * (x[0] + x[1] + x[2]) - start.centroid;
}

}  // namespace

// Over its elements as they are added: centre at the start, area, and whether the field moves any.
void measure_cells(const MetalView& metal) {
    SubShells& cells = metal.cells();
    const uint32_t count = metal.cell_count();
    for (uint32_t c = 0; c < count; ++c) {
        const uint32_t row = metal.cell(c);
        cells.place.set(row, {});
        cells.weights[row] = 0;
        cells.is_touched[row] = 0;
    }
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        if (metal.is_dead(e)) continue;
        const uint32_t row = metal.cell(metal.cell_of(e));
        const Place start = start_of(metal, e);
        const auto area = static_cast<float>(start.area);
        cells.place.set(row, cells.place[row] + area * start.centroid.to_float());
        cells.weights[row] += area;
        for (const uint32_t v : metal.corners(e))
            if (metal.vertices().field[metal.vertex(v)] > 0) cells.is_touched[row] = 1;
    }
    for (uint32_t c = 0; c < count; ++c) {
        const uint32_t row = metal.cell(c);
        if (cells.weights[row] > 0) cells.place.set(row, (1 / cells.weights[row]) * cells.place[row]);
    }
}

namespace {

/// Their mean displacements, as it is now; that of what is not touched is none.
void measure_ways(const MetalView& metal) {
    SubShells& cells = metal.cells();
    for (uint32_t c = 0; c < metal.cell_count(); ++c) cells.moved.set(metal.cell(c), {});
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        const uint32_t row = metal.cell(metal.cell_of(e));
        if (!cells.is_touched[row] || metal.is_dead(e)) continue;
        const Place start = start_of(metal, e);
        const Vec3 way = way_of(metal, e, start).to_float();
        cells.moved.set(row, cells.moved[row] + static_cast<float>(start.area) * way);
    }
    for (uint32_t c = 0; c < metal.cell_count(); ++c) {
        const uint32_t row = metal.cell(c);
        if (cells.weights[row] > 0) cells.moved.set(row, (1 / cells.weights[row]) * cells.moved[row]);
    }
}

// Weighted by borders: how much nearer its neighbours are.
float shortening_of(const MetalView& metal, uint32_t c) {
    const SubShells& cells = metal.cells();
    const uint32_t row = metal.cell(c);
    float sum = 0, weight = 0;
    metal.for_each_border(c, [&](uint32_t other, float border) {
        const uint32_t o = metal.cell(other);
        const Vec3 before = cells.place[row] - cells.place[o], after = before + cells.moved[row] - cells.moved[o];
        const float far = length(before);
        if (far > 0) sum += border * std::max(0.0f, 1 - length(after) / far);
        weight += border;
    });
    return weight > 0 ? std::min(kMostShortening, sum / weight) : 0;
}

// The most shortened comes first, and goes inward; each next one against the majority of its neighbours that are
// decided.
void choose_folds(const MetalView& metal) {
    SubShells& cells = metal.cells();
    const uint32_t count = metal.cell_count();
    for (uint32_t c = 0; c < count; ++c) {
        const uint32_t row = metal.cell(c);
        cells.shortening[row] = cells.is_touched[row] ? shortening_of(metal, c) : 0;
        cells.fold[row] = 0;
    }
    for (uint32_t done = 0; done < count; ++done) {
        uint32_t next = kNone;
        for (uint32_t c = 0; c < count; ++c) {
            const uint32_t row = metal.cell(c);
            if (cells.fold[row] != 0 || !(cells.shortening[row] > kLeastShortening)) continue;
            if (next == kNone || cells.shortening[row] > cells.shortening[metal.cell(next)]) next = c;
        }
        if (next == kNone) return;
        float majority = 0;
        metal.for_each_border(next, [&](uint32_t other, float) {
            const uint32_t o = metal.cell(other);
            if (cells.fold[o] != 0) majority += cells.fold[o] > 0 ? cells.shortening[o] : -cells.shortening[o];
        });
        const uint32_t row = metal.cell(next);
        const float e = cells.shortening[row], sign = majority < 0 ? 1.0f : -1.0f;
        // A gate of 0 still decides its neighbours' signs.
        cells.fold[row] =
            sign * std::max(1e-12f, kFoldHeight * cells.extent[row] * std::sqrt(e * (2 - e)) * cells.gate[row]);
    }
}

/// Sums over a sub-shell's elements, by area.
struct Fit {
    Sym3d second;
    Vec3d turning;
};
Vec3d turn_of(const Fit& fit) {
    Sym3d inertia = inertia_of(fit.second);
    const double scale = trace(inertia);
    inertia.xx += 1e-4 * scale, inertia.yy += 1e-4 * scale, inertia.zz += 1e-4 * scale;
    const Vec3d turn = inverse(inertia) * fit.turning;
    const double size = length(turn);
    return size > kMostTurn ? (kMostTurn / size) * turn : turn;
}

// Rotation of each sub-shell that fits its displacement best.
void fit_turns(const MetalView& metal) {
    SubShells& cells = metal.cells();
    const ScratchArray<Fit> fits(metal.shell.state.scratch, metal.cell_count());
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        const uint32_t c = metal.cell_of(e), row = metal.cell(c);
        if (!cells.is_touched[row] || metal.is_dead(e)) continue;
        const Place start = start_of(metal, e);
        const Vec3d arm = start.centroid - Vec3d(cells.place[row]);
        Fit& fit = fits[c];
        fit.second = fit.second + start.area * outer(arm);
        fit.turning += start.area * cross(arm, way_of(metal, e, start) - Vec3d(cells.moved[row]));
    }
    for (uint32_t c = 0; c < metal.cell_count(); ++c) {
        const uint32_t row = metal.cell(c);
        cells.turn.set(row, cells.is_touched[row] ? turn_of(fits[c]).to_float() : Vec3{});
    }
}

/// A rotation, made ready for many vectors.
struct Turning {
    Vec3d axis;
    double sine = 0, cosine = 1;
    bool is_any = false;

    Turning() = default;
    explicit Turning(Vec3 turn) {
        const double angle = length(Vec3d(turn));
        if (!(angle > 0)) return;
        sine_cosine(angle, sine, cosine);
        axis = (1 / angle) * Vec3d(turn);
        is_any = true;
    }
    Vec3 of(Vec3 arm) const {
        if (!is_any) return arm;
        const Vec3d a(arm);
        return (cosine * a + sine * cross(axis, a) + ((1 - cosine) * dot(axis, a)) * axis).to_float();
    }
};

void choose_creases(const MetalView& metal, double contact) {
    SubShells& cells = metal.cells();
    for (uint32_t c = 0; c < metal.cell_count(); ++c) {
        const uint32_t row = metal.cell(c);
        cells.crease[row] = 0;
        if (!cells.is_touched[row]) continue;
        float most = 0;
        metal.for_each_border(c, [&](uint32_t other, float) {
            if (cells.is_touched[metal.cell(other)])
                most = std::max(most, length(cells.turn[row] - cells.turn[metal.cell(other)]));
        });
        const float small = std::min(1.0f, static_cast<float>(contact) / std::max(cells.extent[row], 1e-9f));
        cells.crease[row] =
            std::fabs(cells.fold[row]) > 1e-9f ? kFoldedCrease : kCrease * std::min(1.0f, most / kFullTurn) * small;
    }
}

}  // namespace

void place_field(const MetalView& metal, Vec3d push) {
    MetalVertices& vertices = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        const float u = vertices.field[row];
        vertices.place.set(row, u > 0 ? vertices.start[row] + u * push.to_float() : vertices.start[row]);
    }
}

namespace {

/// How much a vertex goes with its sub-shells: all the way where the field is at its greatest, not at all where it
/// ends. Else what moves would stand off from what does not, and the sheet would look torn along the end of the field.
class Hold {
 public:
    explicit Hold(const MetalView& metal) : field_(metal.vertices().field) {
        for (uint32_t v = 0; v < metal.vertex_count(); ++v) full_ = std::max(full_, field_[metal.vertex(v)]);
        full_ *= kFullHold;
    }
    float at(uint32_t row) const {
        if (!(field_[row] < full_)) return 1;
        const float share = field_[row] / full_;
        return share * share * (3 - 2 * share);
    }

 private:
    const Column<float>& field_;
    float full_ = 0;
};

/// visit(row of a sub-shell, weight) for all that move a vertex: eight by their weights, or as published the lowest
/// that it is part of.
template <class Visit>
void for_each_mover(const MetalView& metal, uint32_t row, Visit visit) {
    const MetalVertices& vertices = metal.vertices();
    if (metal.shells().published[metal.row] & kPublishedBorders) {
        if (vertices.mover[row] != kNoMover) visit(metal.cell(vertices.mover[row]), 1.0f);
        return;
    }
    for (uint32_t k = 0; k < kBlended; ++k) visit(metal.cell(vertices.cell[row][k]), vertices.weight[row][k]);
}

}  // namespace

void choose_lowest(const MetalView& metal) {
    MetalVertices& vertices = metal.vertices();
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) vertices.mover[metal.vertex(v)] = kNoMover;
    for (uint32_t e = 0; e < metal.element_count(); ++e) {
        if (metal.is_dead(e)) continue;
        for (const uint32_t v : metal.corners(e)) {
            uint16_t& lowest = vertices.mover[metal.vertex(v)];
            lowest = std::min(lowest, static_cast<uint16_t>(metal.cell_of(e)));
        }
    }
}

void fold_cells(const MetalView& metal) {
    measure_ways(metal);
    choose_folds(metal);
    MetalVertices& vertices = metal.vertices();
    const SubShells& cells = metal.cells();
    const Hold hold(metal);
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        if (!(vertices.field[row] > 0)) continue;
        Vec3 way;
        for_each_mover(metal, row, [&](uint32_t c, float weight) { way += (weight * cells.fold[c]) * cells.axis[c]; });
        vertices.place.set(row, vertices.place[row] + hold.at(row) * way);
    }
}

void crease_cells(const MetalView& metal, double contact) {
    measure_ways(metal);
    fit_turns(metal);
    choose_creases(metal, contact);
    MetalVertices& vertices = metal.vertices();
    const SubShells& cells = metal.cells();
    const Hold hold(metal);
    const ScratchArray<Turning> turnings(metal.shell.state.scratch, metal.cell_count());
    for (uint32_t c = 0; c < metal.cell_count(); ++c) turnings[c] = Turning(cells.turn[metal.cell(c)]);
    const uint32_t first = metal.cell(0);
    for (uint32_t v = 0; v < metal.vertex_count(); ++v) {
        const uint32_t row = metal.vertex(v);
        if (!(vertices.field[row] > 0)) continue;
        float chi = 0;
        for_each_mover(metal, row, [&](uint32_t c, float weight) { chi += weight * cells.crease[c]; });
        chi *= hold.at(row);
        if (chi == 0) continue;
        Vec3 rigid;
        for_each_mover(metal, row, [&](uint32_t c, float weight) {
            rigid += weight *
                     (turnings[c - first].of(vertices.start[row] - cells.place[c]) + cells.place[c] + cells.moved[c]);
        });
        vertices.place.set(row, (1 - chi) * vertices.place[row] + chi * rigid);
    }
}

}  // namespace cullet
