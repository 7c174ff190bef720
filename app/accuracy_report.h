// What `vindu measure accuracy` prints: tables for people, or JSON.
#pragma once

#include <string>

#include "app/accuracy.h"

namespace vindu::app {

std::string accuracy_tables(const Accuracy& accuracy, const AccuracyOptions& options);

/// Lengths in millimetres, angles in degrees; `picture` is the plot's file.
std::string accuracy_json(const Accuracy& accuracy, const AccuracyOptions& options,
                          const std::string& picture);

}  // namespace vindu::app
