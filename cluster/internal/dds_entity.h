// Owners of Cyclone's handles. Private to cluster.
#pragma once

#include <dds/dds.h>

#include <memory>
#include <string>
#include <utility>

#include "core/error.h"

namespace vindu::internal {

/// A handle that is deleted, with all that was created in it, at the end. Move-only.
class DdsEntity {
 public:
  DdsEntity() = default;
  /// Throws Error where `handle` is an error code; `what` could then not be made.
  DdsEntity(dds_entity_t handle, const std::string& what) : handle_(handle) {
    if (handle < 0)
      throw Error({.what = "could not make " + what + " (" + dds_strretcode(-handle) + ")",
                   .where = "DDS",
                   .remedy = ""});
  }
  DdsEntity(DdsEntity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  DdsEntity& operator=(DdsEntity&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  DdsEntity(const DdsEntity&) = delete;
  DdsEntity& operator=(const DdsEntity&) = delete;
  ~DdsEntity() {
    if (handle_ > 0) dds_delete(handle_);
  }

  dds_entity_t get() const { return handle_; }

 private:
  dds_entity_t handle_ = 0;
};

using DdsQos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;
inline DdsQos make_dds_qos() { return {dds_create_qos(), &dds_delete_qos}; }

using DdsListener = std::unique_ptr<dds_listener_t, decltype(&dds_delete_listener)>;
inline DdsListener make_dds_listener(void* argument) {
  return {dds_create_listener(argument), &dds_delete_listener};
}

}  // namespace vindu::internal
