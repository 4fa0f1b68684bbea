#include "systems/structures/tetrahedra/solid_rows.hpp"

#include "engine/hash.hpp"
#include "systems/structures/tetrahedra/cook/cover_lattice.hpp"
#include "systems/structures/tetrahedra/cook/crack_region.hpp"
#include "systems/structures/tetrahedra/skin.hpp"

namespace cullet {
namespace {

uint32_t size_of(const auto& list) {
    return static_cast<uint32_t>(list.size());
}

CookedRoom room_for(const CookedSolid& cooked) {
    const Solid& solid = cooked.solid;
    CookedRoom room;
    room.lattice_points = size_of(solid.lattice.points);
    room.tetrahedra = size_of(solid.lattice.fine);
    room.coarse = size_of(solid.lattice.coarse);
    room.windings = size_of(cooked.windings.list);
    room.cells = size_of(solid.cells);
    room.raw = size_of(cooked.raw);
    room.moments = size_of(solid.moments);
    room.bonds = size_of(solid.bonds);
    room.patches = size_of(solid.patches);
    room.points = size_of(cooked.mesh.positions);
    room.triangles = size_of(cooked.mesh.triangles);
    return room;
}

void write_lattice(SolidRows rows, const CookedSolid& cooked, Row<CookedSolids> row) {
    const CoverLattice& lattice = cooked.solid.lattice;
    const CookedSolids& own = rows.cooked_solids;
    uint32_t r = own.lattice_points[row].first;
    for (uint32_t p = 0; p < lattice.points.size(); ++p, ++r) {
        rows.lattice_nodes.place.set(r, lattice.points[p]);
        rows.lattice_nodes.first_winding[r] = cooked.windings.first[p];
        rows.lattice_nodes.winding_count[r] = cooked.windings.first[p + 1] - cooked.windings.first[p];
    }
    r = own.windings[row].first;
    for (const Winding& w : cooked.windings.list) {
        rows.point_windings.part[r] = w.part;
        rows.point_windings.count[r++] = static_cast<uint32_t>(w.count);
    }
    r = own.tetrahedra[row].first;
    for (uint32_t t = 0; t < lattice.fine.size(); ++t, ++r) {
        rows.tetrahedra.corners[r] = lattice.fine[t];
        rows.tetrahedra.coarse[r] = lattice.coarse_of[t];
    }
    r = own.coarse[row].first;
    for (const TenNodes& nodes : lattice.coarse) rows.coarse_tetrahedra.nodes[r++] = nodes;
}

void write_cells(SolidRows rows, const Solid& solid, Row<CookedSolids> row) {
    const CookedSolids& own = rows.cooked_solids;
    uint32_t r = own.cells[row].first;
    for (const SolidCell& c : solid.cells) {
        rows.solid_cells.tetrahedron[r] = c.tetrahedron;
        rows.solid_cells.volume[r] = c.volume;
        rows.solid_cells.centroid.set(r++, c.centroid);
    }
    r = own.moments[row].first;
    for (const CellMoments& m : solid.moments) {
        rows.solid_moments.cell[r] = m.cell, rows.solid_moments.coarse[r] = m.coarse;
        rows.solid_moments.moments[r++] = m.moments;
    }
    r = own.bonds[row].first;
    for (const SolidBond& b : solid.bonds) {
        SolidBondRows& bonds = rows.solid_bonds;
        bonds.a[r] = b.a, bonds.b[r] = b.b, bonds.tetrahedron[r] = b.tetrahedron, bonds.face[r] = b.face;
        bonds.area[r] = b.area;
        bonds.centroid.set(r, b.centroid);
        bonds.normal.set(r++, b.normal);
    }
    r = own.patches[row].first;
    for (const SurfacePatch& p : solid.patches) {
        SolidPatches& patches = rows.solid_patches;
        patches.triangle[r] = p.triangle, patches.cell[r] = p.cell, patches.area[r] = p.area;
        patches.centroid.set(r++, p.centroid);
    }
}

void write_skin(SolidRows rows, const CookedSolid& cooked, const Mesh& mesh, Row<CookedSolids> row) {
    const ClosedMesh& closed = cooked.mesh;
    const CookedSolids& own = rows.cooked_solids;
    uint32_t r = own.points[row].first;
    for (uint32_t p = 0; p < closed.positions.size(); ++p, ++r) {
        rows.skin_points.place.set(r, closed.positions[p]);
        rows.skin_points.tetrahedron[r] = cooked.tetrahedron_of[p];
    }
    const uint32_t first = own.triangles[row].first, first_mesh = own.mesh_triangles[row].first;
    SkinTriangles& skin = rows.skin_triangles;
    for (uint32_t t = 0; t < closed.triangles.size(); ++t) {
        r = first + t;
        const Triangle& c = closed.triangles[t];
        skin.corners[r] = {c[0], c[1], c[2]};
        rows.mesh_triangles.sides[first_mesh + t] = {closed.sides[t][0], closed.sides[t][1], closed.sides[t][2]};
        rows.mesh_triangles.part[first_mesh + t] = closed.part_of[t];
        const uint32_t source = closed.source[t];
        skin.is_inside[r] = source == kNone;
        skin.drawn_material[r] = source == kNone || mesh.materials.empty() ? uint16_t{0} : mesh.materials[source];
        const Vec3d flat =
            cross(closed.positions[c[1]] - closed.positions[c[0]], closed.positions[c[2]] - closed.positions[c[0]]);
        const Vec3 own_normal = (1 / std::max(length(flat), 1e-300) * flat).to_float();
        skin.uv[r] = {};
        for (uint32_t k = 0; k < 3; ++k) {
            Vec3 normal = own_normal;
            if (source == kNone) {
                const auto uv = inside_uv(closed.positions[c[k]], flat, closed.low, closed.high);
                skin.uv[r][2 * k] = uv[0], skin.uv[r][2 * k + 1] = uv[1];
            } else {
                const size_t corner = 3 * size_t{source} + closed.source_corners[t][k];
                if (!mesh.corner_normals.empty()) normal = mesh.corner_normals[corner];
                if (!mesh.corner_uvs.empty())
                    skin.uv[r][2 * k] = mesh.corner_uvs[corner].x, skin.uv[r][2 * k + 1] = mesh.corner_uvs[corner].y;
            }
            skin.normals[r][3 * k] = normal.x, skin.normals[r][3 * k + 1] = normal.y;
            skin.normals[r][3 * k + 2] = normal.z;
        }
    }
}

/// Of places, cells and bonds: two that differ anywhere that a break looks at have other numbers.
uint64_t content_of(const CookedSolid& cooked) {
    const auto add = [](uint64_t hash, const auto& list) {
        return hash_bytes(list.data(), list.size() * sizeof list[0], hash);
    };
    uint64_t hash = add(0, cooked.solid.lattice.points);
    hash = add(hash, cooked.solid.lattice.fine);
    hash = add(hash, cooked.mesh.positions);
    hash = add(hash, cooked.mesh.triangles);
    for (const SolidCell& c : cooked.solid.cells) hash = hash_bytes(&c.volume, sizeof c.volume, hash);
    for (const SolidBond& b : cooked.solid.bonds) hash = hash_bytes(&b.area, sizeof b.area, hash);
    return hash;
}

/// Which two sides of triangles are a pair.
void find_pairs(ClosedMesh& mesh) {
    uint32_t count = 0;
    for (const Triangle& side : mesh.sides)
        for (const uint32_t pair : side) count = std::max(count, pair + 1);
    mesh.pairs.assign(count, {});
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
            mesh.pairs[mesh.sides[t][k]] = {std::min(a, b), std::max(a, b)};
        }
}

void read_mesh(Read<SolidRows> rows, Row<CookedSolids> row, CookedSolid& cooked) {
    const CookedSolids& own = rows.cooked_solids;
    ClosedMesh& mesh = cooked.mesh;
    const Range points = own.points[row], triangles = own.triangles[row];
    for (uint32_t p = points.first; p < points.first + points.count; ++p) {
        mesh.positions.push_back(rows.skin_points.place[p]);
        cooked.tetrahedron_of.push_back(rows.skin_points.tetrahedron[p]);
    }
    for (uint32_t t = 0; t < triangles.count; ++t) {
        const auto& c = rows.skin_triangles.corners[triangles.first + t];
        const auto& s = rows.mesh_triangles.sides[own.mesh_triangles[row].first + t];
        mesh.triangles.push_back({c[0], c[1], c[2]});
        mesh.sides.push_back({s[0], s[1], s[2]});
        mesh.part_of.push_back(rows.mesh_triangles.part[own.mesh_triangles[row].first + t]);
        mesh.source.push_back(rows.skin_triangles.is_inside[triangles.first + t] ? kNone : t);
        mesh.source_corners.push_back({0, 1, 2});
    }
    find_pairs(mesh);
    mesh.part_count = own.parts[row];
    mesh.volume = own.volume[row], mesh.area = own.area[row];
    mesh.low = own.low[row], mesh.high = own.high[row];
}

}  // namespace

Row<Structures> write_solid(SolidRows rows, const CookedSolid& cooked, const Mesh& mesh, const char** full) {
    const Row<CookedSolids> row = make_cooked(rows, room_for(cooked), full);
    if (!row.exists()) return {};
    const Row<Structures> structure = make_solid(rows, row, {}, full);
    if (!structure.exists()) {
        for_each_cooked_range(rows, row, {},
                              [](Range& range, auto& table, uint32_t, const char*) { table.give_back(range); });
        rows.cooked_solids.clear_rows(row, 1);
        rows.cooked_solids.pool.give_back(row, 1);
        return {};
    }
    CookedSolids& own = rows.cooked_solids;
    for_each_cooked_range(rows, row, {},
                          [](Range& range, auto&, uint32_t, const char*) { range.count = range.capacity; });
    own.content[row] = content_of(cooked);
    own.edge[row] = cooked.solid.lattice.edge;
    own.volume[row] = cooked.solid.volume, own.area[row] = cooked.solid.area;
    own.thickness[row] = cooked.solid.thickness;
    own.low.set(row, cooked.mesh.low), own.high.set(row, cooked.mesh.high);
    own.parts[row] = cooked.mesh.part_count;
    write_lattice(rows, cooked, row);
    write_cells(rows, cooked.solid, row);
    uint32_t r = own.raw[row].first;
    for (const RawCell& part : cooked.raw) {
        rows.raw_cells.tetrahedron[r] = part.tetrahedron, rows.raw_cells.cell[r] = part.cell;
        rows.raw_cells.centroid.set(r++, part.centroid);
    }
    write_skin(rows, cooked, mesh, row);
    const Row<Solids> solid = solid_of(rows.structures, structure);
    rows.solids.is_whole[solid] = 1;
    rows.solids.volume[solid] = cooked.solid.volume;
    rows.structures.live_elements[structure] = size_of(cooked.solid.cells);
    return structure;
}

CookedSolid read_solid(Read<SolidRows> rows, Row<CookedSolids> row) {
    const CookedSolids& own = rows.cooked_solids;
    CookedSolid cooked;
    Solid& solid = cooked.solid;
    CoverLattice& lattice = solid.lattice;
    lattice.edge = own.edge[row];
    solid.volume = own.volume[row], solid.area = own.area[row], solid.thickness = own.thickness[row];
    const auto each = [](const Range& range, auto&& f) {
        for (uint32_t r = range.first; r < range.first + range.count; ++r) f(r);
    };
    each(own.lattice_points[row], [&](uint32_t r) {
        lattice.points.push_back(rows.lattice_nodes.place[r]);
        cooked.windings.first.push_back(rows.lattice_nodes.first_winding[r]);
    });
    each(own.windings[row], [&](uint32_t r) {
        cooked.windings.list.push_back(
            {rows.point_windings.part[r], static_cast<int32_t>(rows.point_windings.count[r])});
    });
    cooked.windings.first.push_back(size_of(cooked.windings.list));
    each(own.tetrahedra[row], [&](uint32_t r) {
        lattice.fine.push_back(rows.tetrahedra.corners[r]);
        lattice.coarse_of.push_back(rows.tetrahedra.coarse[r]);
    });
    each(own.coarse[row], [&](uint32_t r) { lattice.coarse.push_back(rows.coarse_tetrahedra.nodes[r]); });
    find_neighbours(lattice);
    each(own.cells[row], [&](uint32_t r) {
        solid.cells.push_back(
            {rows.solid_cells.tetrahedron[r], rows.solid_cells.volume[r], rows.solid_cells.centroid[r]});
    });
    each(own.raw[row], [&](uint32_t r) {
        cooked.raw.push_back({rows.raw_cells.tetrahedron[r], rows.raw_cells.cell[r], rows.raw_cells.centroid[r]});
    });
    each(own.moments[row], [&](uint32_t r) {
        solid.moments.push_back(
            {rows.solid_moments.cell[r], rows.solid_moments.coarse[r], rows.solid_moments.moments[r]});
    });
    each(own.bonds[row], [&](uint32_t r) {
        const SolidBondRows& b = rows.solid_bonds;
        solid.bonds.push_back({b.a[r], b.b[r], b.tetrahedron[r], b.face[r], b.area[r], b.centroid[r], b.normal[r]});
    });
    each(own.patches[row], [&](uint32_t r) {
        const SolidPatches& p = rows.solid_patches;
        solid.patches.push_back({p.triangle[r], p.cell[r], p.area[r], p.centroid[r]});
    });
    read_mesh(rows, row, cooked);
    cooked.faces = number_faces(lattice);
    cooked.owner_of_empty = owners_of_empty(cooked);
    return cooked;
}

}  // namespace cullet
