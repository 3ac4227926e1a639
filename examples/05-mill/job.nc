%
G21 G90 G54
G0 Z5
o<touch> call [-20] [240]                  (a file: lib/touch.ngc)
#<_plc_main.Surface> = #<_value>           (the PLC program learns where the plate is)
G92 Z2                                     (the tool stands 2 mm above it: the surface is Z0)
M101 P3                                    (the PLC program closes clamp 3 and confirms)
M3 S1200
G0 X10 Y10
o1 if [#<_plc_main.Depth> GT 1]            (read when the axes stand here)
  #<cut> = 1
o1 else
  #<cut> = #<_plc_main.Depth>
o1 endif
F1200
G1 Z[-#<cut>]
M62 P1                                     (coolant, with the next move)
G5.2 X20 Y10 P0.7071067811865476 L3        (a quarter circle as a NURBS)
X20 Y20 P1
G5.3
M63 P1
G1 X10
M66 P2 L3 Q5                               (waits for the door)
o2 if [#5399 LT 0]
  (ABORT, the door did not close)
o2 endif
G0 Z5
#<_plc_main.Parts> = [#<_plc_main.Parts> + 1]
G92.1
M30
%
