#pragma once
#include "components/bodies.hpp"
#include "cullet/events.hpp"

namespace cullet {

/// The row of a model that is there, or a row that does not exist.
Row<Models> model_row(const Models& models, ModelId id);

}  // namespace cullet
