"""Line of sight in a world of square pixels, exactly, for many readings at once.

A ray of the sensor is stopped by a wall pixel's square. Seen from the robot, only those
sides of wall pixels matter that border on a free pixel and face the robot; in a line
they merge into *faces* (`occsim.rays.faces`). Each face covers an interval of bearings;
sorting the ends of all intervals and keeping the nearest face between two neighbouring
ends gives the outline of what is seen (`occsim.rays.outline`). The outline is then
counted into cells line by line of pixel centres (`occsim.rays.scan`). No ray is
sampled: each pixel is classified as if its own ray had been walked.
"""
