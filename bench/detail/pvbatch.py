"""ParaView's pvbatch on a model: seconds of a frame, and from the start to the first picture.

Usage: pvbatch pvbatch.py MODEL WIDTH HEIGHT DISTANCE VIEW_ANGLE_DEG FRAMES PICTURE

The eye stands DISTANCE before the middle of the model's box, on -y with z up, and moves a little
from frame to frame, as detail_bench's does. Prints two numbers.
"""
import sys
import time

START_S = time.monotonic()

from paraview import simple  # noqa: E402  (what it takes to load counts)

model, width_px, height_px, distance, view_angle_deg, frames, picture = sys.argv[1:]
source = simple.PLYReader(FileNames=[model])
view = simple.CreateView("RenderView")
view.ViewSize = [int(width_px), int(height_px)]
view.OrientationAxesVisibility = 0
shown = simple.Show(source, view)
simple.ColorBy(shown, ("POINTS", "RGB"))
shown.MapScalars = 0  # they are colours already
view.MultiSamples = 1

bounds = source.GetDataInformation().GetBounds()
middle = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
view.CameraFocalPoint = middle
view.CameraViewUp = [0, 0, 1]
view.CameraViewAngle = float(view_angle_deg)


def draw(frame):
    view.CameraPosition = [middle[0] + 1e-4 * (frame % 7), middle[1] - float(distance), middle[2]]
    simple.Render(view)


draw(0)
first_s = time.monotonic() - START_S
times_s = []
for frame in range(int(frames)):
    before_s = time.monotonic()
    draw(frame)
    times_s.append(time.monotonic() - before_s)
simple.SaveScreenshot(picture, view)
print(sorted(times_s)[len(times_s) // 2], first_s)
