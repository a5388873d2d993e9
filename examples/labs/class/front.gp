{{! Cost and error of the submissions. An empty block is an error to gnuplot. }}
set title 'Cost and error of the submissions'
set xlabel 'operations per picture, relative to the plain program'
set ylabel 'largest error, steps of 1/255'
set xrange [0:*]
set yrange [0:*]
set key top right
set grid lc rgb '#dddddd'
set offsets graph 0.02, graph 0.05, graph 0.1, 0
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead dt 2 lc rgb '#000000'
{{#others}}
$others << END
{{#point}}
{{operations}} {{error}}
{{/point}}
END
{{/others}}
{{#front}}
$front << END
{{#point}}
{{operations}} {{error}}
{{/point}}
END
{{/front}}
plot {{#others}}$others using 1:2 with points pt 7 lc rgb '{{color}}' title 'others', {{/others}}$front using 1:2 with steps lw 2 lc rgb '{{color}}' notitle, \
  $front using 1:2 with points pt 5 lc rgb '{{color}}' title 'efficient: no other is both cheaper and more exact'
