; Three low cans are to be a tower; in which order that is done is for the planner to find.
(define (problem tower)
  (:domain stacking-arms)
  (:objects right left - arm top - grasp can1 can2 can3 - thing table tray - place)
  (:init (empty left) (empty right) (in can1 table) (in can2 table) (in can3 table))
  (:goal (and (in can3 can2) (in can2 can1) (in can1 tray))))
