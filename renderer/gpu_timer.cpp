#include "renderer/gpu_timer.h"

namespace vindu {

GpuTimer::GpuTimer() {
  for (gl::Query& query : queries_) {
    GLuint name = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &name);
    query = gl::Query(name);
  }
}

void GpuTimer::begin() {
  newest();
  running_ = asked_ - answered_ < kQueries;
  if (running_) glBeginQuery(GL_TIME_ELAPSED, queries_[asked_ % kQueries].name());
}

void GpuTimer::end() {
  if (!running_) return;
  glEndQuery(GL_TIME_ELAPSED);
  ++asked_;
  running_ = false;
}

std::optional<Duration> GpuTimer::newest() {
  while (answered_ < asked_) {
    const GLuint query = queries_[answered_ % kQueries].name();
    GLuint done = GL_FALSE;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT_AVAILABLE, &done);
    if (!done) break;
    GLuint64 elapsed_ns = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &elapsed_ns);
    newest_ = Duration(static_cast<Duration::rep>(elapsed_ns));
    ++answered_;
  }
  return newest_;
}

}  // namespace vindu
