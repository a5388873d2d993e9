{{! A scene's settings: error over time, a point for each; small pictures of some above them. }}
set multiplot
{{#foot}}
set label {{&foot}} at screen 0.99,0.018 right textcolor rgb '#666666'
{{/foot}}
set label {{&title}} at screen 0.5,0.965 center font ',{{title_size}}'
set encoding utf8
set border 3 lc rgb '#444444'
set lmargin at screen {{left}}
set rmargin at screen {{right}}
set bmargin at screen {{bottom}}
set tmargin at screen {{top}}
{{&x_axis}}
{{&y_axis}}
set xlabel 'time of a frame, drawn and read back, in ms' offset 0,0.4
set label 'largest error, in steps of 1/255' at screen 0.022,{{middle}} center rotate
{{#floor}}
set ytics add ('≤{{floor}}' {{floor}})
{{/floor}}
set grid lc rgb '#dddddd' lw 0.6 lt 1
set key at screen 0.5,0.937 center top horizontal reverse Left samplen 1.5 width 1
{{#rounding}}
set arrow from graph 0,first 0.5 to graph 1,first 0.5 nohead back lw 1 dt 2 lc rgb '#999999'
set label 'rounding to 8 bits' at screen {{rounding}},first 0.5 left offset 0,0.5 textcolor rgb '#666666'
{{/rounding}}
{{#setting}}
set label {{&text}} at screen {{x}},{{y}} center front textcolor rgb '#444444'
{{/setting}}
{{#pin}}
set label {{&caption}} at screen {{x0}},{{y}} center front
set arrow from screen {{x0}},{{y0}} to screen {{x1}},{{y1}} nohead back lw 1 lc rgb '#999999'
{{/pin}}

{{! Rows of one interpolation, and the efficient ones of them. }}
{{#other}}
$other{{number}} << EOD
{{#row}}
{{time}} {{error}}
{{/row}}
EOD
{{/other}}
{{#efficient}}
$efficient{{number}} << EOD
{{#row}}
{{time}} {{error}}
{{/row}}
EOD
{{/efficient}}

{{! The line of the efficient ones, with their quartiles; where the machine was busy that instead. }}
{{#front}}
$front << EOD
{{#row}}
{{time}} {{error}} {{lower}} {{width}}
{{/row}}
EOD
{{/front}}
{{#busy}}
set label 'The machine was busy: half the times have a noise of more than {{bound}}%; no setting is marked.' at screen 0.5,{{y}} center front textcolor rgb '#b00000'
{{/busy}}

{{! Later ones cover earlier ones. }}
plot {{#front}}$front using 1:2 with lines lw 1.5 lc rgb '#555555' title 'efficient', \
  $front using 3:2:4:(0) with vectors nohead lw 1.5 lc rgb '#555555' notitle{{/front}}{{#busy}}NaN notitle{{/busy}}{{#other}}, \
  $other{{number}} using 1:2 with points pt {{hollow}} ps 0.5 lw 1 lc rgb '{{color}}' notitle{{/other}}{{#efficient}}, \
  $efficient{{number}} using 1:2 with points pt {{filled}} ps 1.1 lc rgb '{{color}}' notitle, \
  '' using 1:2 with points pt {{hollow}} ps 1.1 lw 1 lc rgb '#000000' notitle{{/efficient}}{{#entry}}, \
  keyentry with points pt {{filled}} ps 0.9 lc rgb '{{color}}' title '{{name}}'{{/entry}}

{{! The pictures, over the plot, in pixels. }}
unset border
unset tics
unset key
unset title
unset xlabel
unset ylabel
unset label
unset arrow
unset grid
unset logscale
set lmargin at screen 0
set rmargin at screen 1
set bmargin at screen 0
set tmargin at screen 1
set xrange [0:{{width}}]
set yrange [0:{{height}}]
{{#picture}}{{join}}{{&path}} binary filetype=png origin=({{x}},{{y}}) dx={{scale}} dy={{scale}} with rgbimage{{/picture}}

unset multiplot
