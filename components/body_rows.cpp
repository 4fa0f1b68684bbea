#include "components/body_rows.hpp"

namespace cullet {

BodyRows::BodyRows(const Limits& l, const MaterialRows& of_what)
    : RunRows(l, of_what),
      bodies(l.bodies, l.bodies),
      pin_boxes(4 * l.bodies + 64),
      fragment_ages(l.bodies),
      view_vertices(l.view_vertices, l.bodies),
      view_indices(l.view_vertices * 2, l.bodies),
      quick_bodies(l.bodies) {}

SoftRows::SoftRows(const Limits& l, const MaterialRows& of_what)
    : BodyRows(l, of_what),
      soft_bodies(l.bodies),
      soft_strikers(l.bodies * kMostStrikers),
      soft_contacts(first_contact_row(l.vertices + kLanes)) {}

}  // namespace cullet
